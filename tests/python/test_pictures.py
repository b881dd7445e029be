# SPDX-License-Identifier: BSD-3-Clause
"""Pictures: those of the tools, pixel for pixel."""

import concurrent.futures

import numpy as np
import pytest
from conftest import pixels_of, raises, warns

import pcl_uvol as uvol


@pytest.mark.parametrize("options, arguments", [
    (dict(), []),
    (dict(color="vel[1]", colormap="coolwarm", range=(-0.2, 0.2), view="front", background="black"),
     ["-color", "vel[1]", "-colormap", "coolwarm", "-range", "-0.2,0.2", "-view", "front", "-background", "black"]),
    (dict(color="none", eye=[3, 2, 1], at=[0.5, 0.5, 0.4], up=[0, 1, 0], fov=20, zoom=1.5, surface_color=[1, 0.2, 0]),
     ["-color", "none", "-eye", "3,2,1", "-at", "0.5,0.5,0.4", "-up", "0,1,0", "-fov", "20", "-zoom", "1.5",
      "-surface-color", "1,0.2,0"]),
    (dict(parallel=True, view="top", color="r"), ["-parallel", "-view", "top", "-color", "r"]),
    (dict(parallel=True, eye=[3, 2, 1]), ["-parallel", "-eye", "3,2,1"]),
    (dict(color="r*2", silhouettes=True, features=True, thickness=3, supersample=1, culling=True, up=[0, 1, 0],
          background="transparent", line_color=[0, 0, 1], footprints=False, bar=False),
     ["-color", "r*2", "-silhouettes", "-features", "-thickness", "3", "-supersample", "1", "-culling",
      "-up", "0,1,0", "-background", "transparent", "-line-color", "0,0,1", "-no-footprints", "-no-bar"]),
    (dict(color="|vel|", log=True, range=(0.1, 0.4), exaggerate=[1, 1, 2], background="gradient",
          lights=[[0, 0, 1], [1, 0, 0]], material=dict(ambient=0.3, diffuse=0.5, specular=0.1, shininess=5)),
     ["-color", "|vel|", "-log", "-range", "0.1,0.4", "-exaggerate", "1,1,2", "-background", "gradient",
      "-lights", "0,0,1;1,0,0", "-ambient", "0.3", "-diffuse", "0.5", "-specular", "0.1", "-shininess", "5"]),
    (dict(color="rint(id / 1500)", footprints=False,
          passes=dict(fill=3, occluded=1, layers=0.01, smoothing="box", smoothings=2, antialias=False)),
     ["-color", "rint(id / 1500)", "-no-footprints", "-fill", "3", "-occluded", "1", "-layers", "0.01", "-smoothing", "box",
      "-smoothings", "2", "-no-antialias"]),
])
def test_uvol_render_draws_the_same(tmp_path, run_tool, sphere, options, arguments):
    sphere.save(tmp_path / "in.ply")
    run_tool("uvol_render", "in.ply", "tool.png", "-size", "200x150", "-backend", "cpu", *arguments)
    uvol.read(tmp_path / "in.ply").render(size=(200, 150), **options).save(tmp_path / "module.png")
    assert pixels_of(tmp_path / "module.png") == pixels_of(tmp_path / "tool.png")


@pytest.mark.parametrize("options, arguments", [
    (dict(ticks=True, unit="km", title="A sphere", triad=True), ["-ticks", "-unit", "km", "-title", "A sphere", "-triad"]),
    (dict(box=True, scale_bar=True, views=["iso", "top", "left"], background="gradient", color="r"),
     ["-box", "-scale-bar", "-views", "iso,top,left", "-background", "gradient", "-color", "r"]),
    (dict(title="T", exaggerate=[1, 1, 3], ticks=True, background="transparent", bar=False, color="r"),
     ["-title", "T", "-exaggerate", "1,1,3", "-ticks", "-background", "transparent", "-no-bar", "-color", "r"]),
])
@pytest.mark.parametrize("tool", ["uvol_render", "uvol_raytrace"])
def test_figures_are_those_of_the_tools(tmp_path, run_tool, sphere, tool, options, arguments):
    sphere.save(tmp_path / "in.ply")
    run_tool(tool, "in.ply", "tool.png", "-size", "300x200", *arguments)
    surface = uvol.read(tmp_path / "in.ply")
    draw = surface.render if tool == "uvol_render" else surface.raytrace
    draw(size=(300, 200), **options).save(tmp_path / "module.png")
    assert pixels_of(tmp_path / "module.png") == pixels_of(tmp_path / "tool.png")


def test_light_goes_through_isosurfaces(tmp_path, run_tool, ball):
    uvol.isosurface(*ball, field="r", iso=[0.2, 0.3, 0.4], outside="higher").save(tmp_path / "in.ply")
    run_tool("uvol_render", "in.ply", "tool.png", "-size", "200x150", "-backend", "cpu", "-opacity", "1,0.5,0.2")
    surface = uvol.read(tmp_path / "in.ply")
    surface.render(size=(200, 150), opacity=[1, 0.5, 0.2]).save(tmp_path / "module.png")
    assert pixels_of(tmp_path / "module.png") == pixels_of(tmp_path / "tool.png")
    with raises(ValueError, "opacities_unlike_isovalues", {"opacities": 2, "isovalues": 3}):
        surface.render(size=100, opacity=[0.1, 0.2])


@pytest.mark.parametrize("raytraced, options, arguments", [
    (False, dict(color="r", zoom=1.2), ["-color", "r", "-zoom", "1.2"]),
    (False, dict(eye=[3, 2, 1], up=[0, 1, 0], views=[]), ["-eye", "3,2,1", "-up", "0,1,0"]),
    (True, dict(view="front", triad=True), ["-view", "front", "-triad"]),
])
def test_orbits_are_those_of_the_tools(tmp_path, run_tool, sphere, raytraced, options, arguments):
    sphere.save(tmp_path / "in.ply")
    run_tool("uvol_raytrace" if raytraced else "uvol_render", "in.ply", "tool.png", "-size", "120x90", "-orbit", "3",
             *arguments)
    frames = uvol.read(tmp_path / "in.ply").orbit(3, raytraced=raytraced, size=(120, 90), **options)
    for number, picture in enumerate(frames):
        picture.save(tmp_path / "module.png")
        assert pixels_of(tmp_path / "module.png") == pixels_of(tmp_path / f"tool_{number}.png")
    assert number == 2


def test_names_are_coloured_as_the_tools_do(tmp_path, run_tool, sphere):
    for count in (12, 30):
        names = [f"n{number % count}" for number in range(len(sphere))]
        fields = {name: sphere[name] for name in ("normal_x", "normal_y", "normal_z")}
        uvol.Samples(sphere.points, {**fields, "hole": names}).save(tmp_path / "in.ply")
        run_tool("uvol_render", "in.ply", "tool.png", "-size", "300x200", "-color", "hole", "-backend", "cpu")
        samples = uvol.read(tmp_path / "in.ply")
        if count > 20:
            with warns("repeated_colors") as warned:
                picture = samples.render(size=(300, 200), color="hole")
            assert {"most": 20, "field": "hole"} in [warning.message.values for warning in warned]
            assert "repeated_colors" in [warning.message.code for warning in warned]
        else:
            picture = samples.render(size=(300, 200), color="hole")
        picture.save(tmp_path / "module.png")
        assert pixels_of(tmp_path / "module.png") == pixels_of(tmp_path / "tool.png")


def test_letters_are_drawn_on_many_threads(sphere):
    options = dict(size=(300, 200), ticks=True, color="r", title="T", threads=1)
    expected = sphere.render(**options).pixels
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        pictures = list(pool.map(lambda _: sphere.render(**options).pixels, range(12)))
    assert all(np.array_equal(picture, expected) for picture in pictures)


@pytest.mark.parametrize("options, arguments", [
    ({}, []),
    (dict(color="r*2", colormap="magma", range=(0.2, 0.9), view="top", background="black", exaggerate=[1, 1, 2]),
     ["-color", "r*2", "-colormap", "magma", "-range", "0.2,0.9", "-view", "top", "-background", "black", "-exaggerate", "1,1,2"]),
    (dict(color="r", bar=False), ["-color", "r", "-no-bar"]),
])
def test_uvol_render_writes_the_same_page(tmp_path, run_tool, sphere, options, arguments):
    sphere.save(tmp_path / "in.ply")
    (tmp_path / "module").mkdir()
    run_tool("uvol_render", "in.ply", "page.html", *arguments)
    report = uvol.read(tmp_path / "in.ply").save_page(tmp_path / "module" / "page.html", **options)
    assert (tmp_path / "module" / "page.html").read_bytes() == (tmp_path / "page.html").read_bytes()
    assert "milliseconds" in report
    with pytest.raises(ValueError, match=".html"):
        sphere.save_page(tmp_path / "page.png")


def test_uvol_raytrace_draws_the_same(tmp_path, run_tool, sphere):
    sphere.save(tmp_path / "in.ply")
    run_tool("uvol_raytrace", "in.ply", "tool.png", "-size", "160x128", "-color", "r", "-reflect", "0.3",
             "-occlusion-rays", "4", "-delta", "0.001", "-background", "0.1,0.2,0.3", "-culling")
    picture = uvol.read(tmp_path / "in.ply").raytrace(size=(160, 128), color="r", reflect=0.3, occlusion=4,
                                                      splats={"delta": 0.001}, background=(0.1, 0.2, 0.3), culling=True)
    picture.save(tmp_path / "module.png")
    assert pixels_of(tmp_path / "module.png") == pixels_of(tmp_path / "tool.png")


def test_uvol_raytrace_draws_the_same_scene(tmp_path, run_tool, sphere):
    sphere.save(tmp_path / "sphere.ply")
    (tmp_path / "test.scene").write_text("""
        background 0.2 0.3 0.4
        size 90 70
        camera eye 2 1.5 1.2 at 0.5 0.5 0.5 fov 30
        material mirror color 0.8 0.2 0.1 reflect 0.5
        cloud sphere.ply material mirror
        """)
    for name, options, arguments in (
            ("file", {}, []),
            ("own", dict(size=(80, 60), view="top", background="white", supersample=2, zoom=1.5),
             ["-size", "80x60", "-view", "top", "-background", "white", "-supersample", "2", "-zoom", "1.5"]),
            ("rays", dict(zoom=2, fov=40, up=[0, 1, 0], depth=0, shadows=False, occlusion=4, occlusion_distance=0.5,
                          light_samples=2, lights=[[1, 0, 1]], culling=True),
             ["-zoom", "2", "-fov", "40", "-up", "0,1,0", "-depth", "0", "-no-shadows", "-occlusion-rays", "4",
              "-occlusion-distance", "0.5", "-light-samples", "2", "-lights", "1,0,1", "-culling"])):
        run_tool("uvol_raytrace", "test.scene", f"{name}.png", *arguments)
        uvol.raytrace(tmp_path / "test.scene", **options).save(tmp_path / "module.png")
        assert pixels_of(tmp_path / "module.png") == pixels_of(tmp_path / f"{name}.png"), name
    run_tool("uvol_raytrace", "test.scene", "turned.png", "-orbit", "3")
    for frame in range(3):
        uvol.raytrace(tmp_path / "test.scene", turn=120 * frame).save(tmp_path / "module.png")
        assert pixels_of(tmp_path / "module.png") == pixels_of(tmp_path / f"turned_{frame}.png")


@pytest.mark.parametrize("view", ["top", "iso"])
def test_uvol_project_draws_the_same(tmp_path, run_tool, ball, view):
    points, fields = ball
    uvol.Samples(points, {**fields, "label": (points[:, 0] > 0.5).astype(np.int32)}).save(tmp_path / "in.ply")
    run_tool("uvol_project", "in.ply", "out.ply", "-attributes", "r,vel[0],vel[1],|vel|", "-png", "tool.png", "-view", view)
    samples = uvol.read(tmp_path / "in.ply")
    found = uvol.project(samples, attributes=["r", "vel[0]", "vel[1]", "|vel|"], labels=samples["label"])
    found.render(view).save(tmp_path / "module.png")
    assert pixels_of(tmp_path / "module.png") == pixels_of(tmp_path / "tool.png")
    assert found._repr_png_()[:4] == b"\x89PNG"
    for options, expected in ((dict(view="up"), dict(code="unknown_view", values={"view": "up"})),
                              (dict(size=0), dict(match="size|16384")), (dict(view=3), dict(match="must be a text"))):
        with raises((ValueError, TypeError), **expected):
            found.render(**options)


def test_a_field_of_vectors_is_coloured_by_their_lengths(sphere):
    assert np.array_equal(sphere.render(size=160, color="vel").pixels, sphere.render(size=160, color="|vel|").pixels)
    assert sphere.render(size=64, color="vel").field == "|vel|"


def test_a_bar_shows_what_colours_mean(sphere):
    with_bar = sphere.render(size=(200, 150), color="r", background="black").pixels
    without = sphere.render(size=(200, 150), color="r", background="black", bar=False).pixels
    assert (with_bar[:, -30:, :3] != 0).any(axis=2).mean() > (without[:, -30:, :3] != 0).any(axis=2).mean()
    assert (with_bar[:, -66:, :3].max(axis=(0, 1)) > 200).all()  # letters are white on black


def test_sizes_may_be_arrays(sphere):
    assert sphere.render(size=np.array([20, 30])).pixels.shape == (30, 20, 4)


def test_a_picture_says_how_large_it_is_printed(tmp_path, sphere):
    picture = sphere.render(size=64)
    picture.save(tmp_path / "plain.png")
    picture.save(tmp_path / "of_300.png", dpi=300)
    chunk = b"\0\0\0\x09pHYs" + 2 * (11811).to_bytes(4, "big") + b"\1"
    assert (tmp_path / "of_300.png").read_bytes()[33:50] == chunk
    assert b"pHYs" not in (tmp_path / "plain.png").read_bytes()


def test_a_picture_is_an_array(sphere):
    picture = sphere.render(size=(50, 40), color="vel[0]")
    assert np.asarray(picture).shape == (40, 50, 4) and picture.pixels.dtype == np.uint8
    assert (picture.pixels[0, 0] == 255).all() and (picture.pixels[20, 25, :3] != 255).any()
    values = sphere["vel"][:, 0]
    assert np.allclose(picture.range, [values.min(), values.max()]) and picture.field == "vel[0]"
    assert "vel[0] from" in repr(picture)
    assert picture._repr_png_()[:4] == b"\x89PNG"


@pytest.mark.parametrize("options, expected", [
    (dict(color="q"), dict(code="unknown_lone_field", values={"field": "q"})),
    (dict(color=3), dict(match="color is 3")),
    (dict(colormap="jet"), dict(code="unknown_color_map", values={"map": "jet"})),
    (dict(size=0), dict(match="0 x 0 is not allowed")),
    (dict(size=(1, 2, 3)), dict(match="size is")),
    (dict(size=10**6), dict(code="bad_picture_size", values={"width": 10**6, "height": 10**6})),
    (dict(view="below"), dict(code="unknown_view", values={"view": "below"})),
    (dict(up=[0, 0, 0]), dict(code="camera_up_of_zero")),
    (dict(range=(2, 1)), dict(code="bad_picture_range")),
    (dict(background="blue"), dict(code="wrong_parameter", values={"name": "background", "value": '"blue"'})),
    (dict(background=(2, 0, 0)), dict(code="bad_picture_color")),
    (dict(eye=[0, 0]), dict(code="wrong_parameter", values={"name": "eye"})),
    (dict(fov=0), dict(code="bad_field_of_view", values={"degrees": 0})),
    (dict(log=True, colormap="tab10", color="r"), dict(code="logarithms_of_categories", values={"map": "tab10"})),
    (dict(log=True, range=(-1, 1), color="r"), dict(code="bad_logarithmic_range")),
    (dict(exaggerate=[1, 1, 0]), dict(code="bad_exaggerate")),
    (dict(lights=[[0, 0, 0]]), dict(code="light_from_nowhere")),
    (dict(lights=[1, 2]), dict(code="wrong_parameter", values={"name": "lights"})),
    (dict(material={"gloss": 1}), dict(code="unknown_parameter", values={"name": "material.gloss"})),
    (dict(passes={"fills": 1}), dict(code="unknown_parameter", values={"name": "passes.fills", "similar": "fill"})),
    (dict(color="|grad(r)|"), dict(code="no_derivatives", values={"field": "|grad(r)|"})),
    (dict(at=[0, 0, 0]), dict(code="picture_at_without_eye")),
    (dict(opacity=2), dict(code="bad_opacity", values={"opacity": 2})),
    (dict(opacity="half"), dict(match="opacity is 'half'")),
    (dict(unit="km"), dict(code="picture_unit_alone")),
    (dict(title=None), dict(match="title is None: it must be a text")),
    (dict(views=3), dict(match="sequence of sides")),
    (dict(opacity=[]), dict(match=r"opacity is \[\]")),
    (dict(supersample=-1), dict(match="supersample is -1")),
    (dict(passes={"smothing": "box"}),
     dict(code="unknown_parameter", values={"name": "passes.smothing", "similar": "smoothing"})),
    (dict(views="iso"), dict(match="sequence of sides")),
    (dict(views=["iso", "below"]), dict(code="unknown_view", values={"view": "below"})),
    (dict(views=["iso", "top"], eye=[1, 2, 3]), dict(code="picture_views_and_eye")),
    (dict(size=20, views=["iso", "top"]), dict(code="picture_too_small_for_views")),
    (dict(scale_bar=True, exaggerate=[1, 1, 2]), dict(code="scale_bar_of_several_scales")),
    (dict(surface_color="red"), dict(match="surface_color is 'red'")),
    (dict(log="no"), dict(match="log is 'no': it must be True or False")),
    (dict(ticks=1), dict(match="ticks is 1")),
])
def test_mistakes_get_a_sentence(sphere, options, expected):
    with raises((ValueError, KeyError, TypeError), **expected):
        sphere.render(**options)
