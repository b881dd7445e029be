# SPDX-License-Identifier: BSD-3-Clause
"""What a listener throws, and Ctrl-C, end everything that may take long; what they ended works again."""

import signal
import threading
import time

import numpy as np
import pytest

import pcl_uvol as uvol

FUNCTIONS = {
    "compute": lambda ball, **how: uvol.Samples(*ball).compute("|grad(r)|", **how)["|grad(r)|"],
    "where": lambda ball, **how: uvol.Samples(*ball).where("|grad(r)| < 2 && r < 0.3", **how).points,
    "density": lambda ball, **how: uvol.Samples(*ball).density(**how)["sph_density"],
    "outer_layer": lambda ball, **how: uvol.Samples(*ball).outer_layer(0.0, "r", **how).points,
    "info": lambda ball, **how: uvol.info(*ball, **how)["spacing"]["median"],
    "sampling": lambda ball, **how: uvol.Samples(*ball).sampling(**how)["spacing_along"],
    "Interpolator": lambda ball, **how: uvol.Interpolator(*ball, field="r", **how)([[0.5, 0.5, 0.5]])[0],
    "level_set": lambda ball, **how: uvol.level_set(*ball, field="r", iso=0.3, mu=0.5, **how)["phi"],
    "normals": lambda ball, **how: uvol.normals(ball[0], **how)["normal_x"],
    "splats": lambda ball, **how: uvol.splats(ball[0], **how).points,
    "cluster": lambda ball, **how: uvol.cluster(*ball, attributes=["r", "x"], **how).labels,
    "project": lambda ball, **how: uvol.project(*ball, attributes=["r", "x"], **how).places,
    "voronoi": lambda ball, **how: uvol.voronoi(ball[0], cells=32, **how).site,
}

METHODS = {
    "mesh": lambda sphere, **how: sphere.mesh(**how).vertices,
    "measure": lambda sphere, **how: sphere.measure(find_intersections=True, **how).volume.value,
    "compare": lambda sphere, **how: uvol.compare(sphere, sphere, **how).largest,
    "render": lambda sphere, **how: sphere.render(size=100, **how).pixels,
    "raytrace": lambda sphere, **how: sphere.raytrace(size=60, **how).pixels,
}


class Enough(Exception):
    pass


def stop(step, done):
    raise Enough


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_listener_ends_functions(ball, name):
    with pytest.raises(Enough):
        FUNCTIONS[name](ball, progress=stop)
    assert np.array_equal(FUNCTIONS[name](ball), FUNCTIONS[name](ball, progress=lambda step, done: None))


@pytest.mark.parametrize("name", METHODS)
def test_a_listener_ends_methods_of_a_surface(sphere, name):
    with pytest.raises(Enough):
        METHODS[name](sphere, progress=stop)
    assert np.array_equal(METHODS[name](sphere), METHODS[name](sphere))


@pytest.mark.parametrize("answer", [
    lambda model, **how: model([[0.5, 0.5, 0.4]], **how)[0],
    lambda model, **how: model.evaluate([[0.5, 0.5, 0.4]], **how).values,
    lambda model, **how: model.grid(20, **how)["r"],
    lambda model, **how: model.probe(model.samples, **how)["r_2_error"],
    lambda model, **how: model.validate(2, **how)["r"]["rms"],
])
def test_a_listener_ends_the_answers_of_a_model(ball, answer):
    model = uvol.Interpolator(*ball, field="r", errors=True, extrapolate=True)
    with pytest.raises(Enough):
        answer(model, progress=stop)
    assert np.array_equal(answer(model), answer(model))


@pytest.mark.parametrize("ending, options", [("csv", {}), ("ply", dict(ascii=True)), ("pcd", dict(ascii=True))])
def test_a_listener_ends_reading_and_writing(tmp_path, ball, ending, options):
    samples, path = uvol.Samples(*ball), tmp_path / f"points.{ending}"
    with pytest.raises(Enough):
        samples.save(path, progress=stop, **options)
    samples.save(path, **options)
    with pytest.raises(Enough):
        uvol.read(path, progress=stop)
    assert np.array_equal(uvol.read(path)["id"], samples["id"])


def test_what_is_interrupted_leaves_no_file(tmp_path):
    samples = uvol.Samples(np.random.default_rng(4).random((400000, 3)))
    begun = time.perf_counter()
    samples.save(tmp_path / "whole.csv")
    timer = threading.Timer(0.2 * (time.perf_counter() - begun), signal.raise_signal, [signal.SIGINT])
    with pytest.raises(KeyboardInterrupt):
        timer.start()
        samples.save(tmp_path / "part.csv")
        timer.join()
        time.sleep(0.1)
    assert [path.name for path in tmp_path.iterdir() if not path.name.startswith(".")] in (
        ["whole.csv"], ["whole.csv", "part.csv"], ["part.csv", "whole.csv"])


def test_ctrl_c_ends_an_outer_layer():
    samples = uvol.Samples(np.random.default_rng(4).random((400000, 3)), {"r": np.zeros(400000)})
    pressed = []

    def press():
        pressed.append(time.process_time())
        signal.raise_signal(signal.SIGINT)

    timer = threading.Timer(0.5, press)
    with pytest.raises(KeyboardInterrupt):
        timer.start()
        samples.outer_layer(1.0, "r")
    assert time.process_time() - pressed[0] < 2.0  # of some five seconds
    assert len(samples) == 400000
