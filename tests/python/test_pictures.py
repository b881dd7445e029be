# SPDX-License-Identifier: BSD-3-Clause
"""Pictures: those of the tools, byte for byte, but for the bar of colours."""

import numpy as np
import pytest

import pcl_uvol as uvol


@pytest.mark.parametrize("options, arguments", [
    (dict(), []),
    (dict(color="vel[1]", colormap="coolwarm", range=(-0.2, 0.2), view="front", background="black"),
     ["-color", "vel[1]", "-colormap", "coolwarm", "-range", "-0.2,0.2", "-view", "front", "-background", "black"]),
    (dict(color="none", eye=[3, 2, 1], at=[0.5, 0.5, 0.4], up=[0, 1, 0], fov=20, zoom=1.5, surface_color=[1, 0.2, 0]),
     ["-color", "none", "-eye", "3,2,1", "-at", "0.5,0.5,0.4", "-up", "0,1,0", "-fov", "20", "-zoom", "1.5",
      "-surface-color", "1,0.2,0"]),
    (dict(color="r*2", silhouettes=True, features=True, thickness=3, supersample=1, culling=True, up=[0, 1, 0],
          background="transparent", line_color=[0, 0, 1], footprints=False),
     ["-color", "r*2", "-silhouettes", "-features", "-thickness", "3", "-supersample", "1", "-culling",
      "-up", "0,1,0", "-background", "transparent", "-line-color", "0,0,1", "-no-footprints"]),
])
def test_uvol_render_draws_the_same(tmp_path, run_tool, sphere, options, arguments):
    sphere.save(tmp_path / "in.ply")
    run_tool("uvol_render", "in.ply", "tool.png", "-size", "160x120", "-no-bar", "-backend", "cpu", *arguments)
    uvol.read(tmp_path / "in.ply").render(size=(160, 120), **options).save(tmp_path / "module.png")
    assert (tmp_path / "module.png").read_bytes() == (tmp_path / "tool.png").read_bytes()


def test_uvol_raytrace_draws_the_same(tmp_path, run_tool, sphere):
    sphere.save(tmp_path / "in.ply")
    run_tool("uvol_raytrace", "in.ply", "tool.png", "-size", "80x60", "-no-bar", "-color", "r", "-reflect", "0.3",
             "-occlusion", "4", "-delta", "0.001", "-background", "0.1,0.2,0.3")
    picture = uvol.read(tmp_path / "in.ply").raytrace(size=(80, 60), color="r", reflect=0.3, occlusion=4,
                                                      splats={"delta": 0.001}, background=(0.1, 0.2, 0.3))
    picture.save(tmp_path / "module.png")
    assert (tmp_path / "module.png").read_bytes() == (tmp_path / "tool.png").read_bytes()


def test_a_picture_is_an_array(sphere):
    picture = sphere.render(size=(50, 40), color="vel[0]")
    assert np.asarray(picture).shape == (40, 50, 4) and picture.pixels.dtype == np.uint8
    assert (picture.pixels[0, 0] == 255).all() and (picture.pixels[20, 25, :3] != 255).any()
    values = sphere["vel"][:, 0]
    assert np.allclose(picture.range, [values.min(), values.max()]) and picture.field == "vel[0]"
    assert "vel[0] from" in repr(picture)
    assert picture._repr_png_()[:4] == b"\x89PNG"


@pytest.mark.parametrize("options, message", [
    (dict(color="q"), "no field"),
    (dict(color=3), "color is 3"),
    (dict(colormap="jet"), "jet"),
    (dict(size=0), "1 x 1"),
    (dict(size=(1, 2, 3)), "size is"),
    (dict(size=10**6), "width lies between"),
    (dict(view="below"), "below"),
    (dict(up=[0, 0, 0]), "none"),
    (dict(range=(2, 1)), "lower one first"),
    (dict(background="blue"), "white"),
    (dict(background=(2, 0, 0)), "from 0 to 1"),
    (dict(eye=[0, 0]), "list of 3"),
    (dict(fov=0), "field of view"),
])
def test_mistakes_get_a_sentence(sphere, options, message):
    with pytest.raises((ValueError, KeyError, TypeError), match=message):
        sphere.render(**options)
