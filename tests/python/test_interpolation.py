# SPDX-License-Identifier: BSD-3-Clause
"""Fields between the samples: the tool's own answers, arrays of the right shapes."""

import json
import pickle
import threading

import numpy as np
import pytest
from conftest import pixels_of, raises, warns

import pcl_uvol as uvol


@pytest.fixture
def linear():
    """Samples of a linear field, far from the origin."""
    points = np.random.default_rng(11).random((2000, 3)) + [5e5, 4e6, 0]
    return uvol.Samples(points, {"f": (points - [5e5, 4e6, 0]) @ [1, 2, 3], "g": np.ones(2000, np.float32)})


@pytest.mark.parametrize("model", ["fit", "natural", "laplace", "auto"])
def test_linear_fields_are_predicted_exactly(linear, model):
    interpolator = uvol.Interpolator(linear, field="f", model=model)
    queries = np.random.default_rng(12).uniform(0.2, 0.8, (40, 3))
    answers = interpolator.evaluate(queries + [5e5, 4e6, 0])
    assert np.allclose(answers.values, queries @ [1, 2, 3], atol=1e-4)
    assert np.allclose(answers.gradients, [1, 2, 3], atol=1e-3)
    assert np.isin(answers.support, [1, 2]).all()


def test_shapes_follow_queries_and_fields(linear):
    queries = np.full((4, 5, 3), 0.5) + [5e5, 4e6, 0]
    one = uvol.Interpolator(linear, field="f").evaluate(queries)
    assert one.values.shape == one.errors.shape == one.support.shape == (4, 5)
    assert one.gradients.shape == (4, 5, 3)
    two = uvol.Interpolator(linear, field=["f", "g", "f*g"], gradients=False, errors=False).evaluate(queries)
    assert two.values.shape == (3, 4, 5) and two.gradients is None and two.errors is None
    assert np.allclose(two.values[0], two.values[2])
    values, errors = uvol.Interpolator(linear, field="f")(queries[0, 0])
    assert values.shape == errors.shape == ()
    assert uvol.Interpolator(linear, field="f")(np.empty((0, 3)))[0].shape == (0,)
    none = uvol.Interpolator(linear, field="f", errors=False, gradients=False).evaluate(np.empty((0, 3)))
    assert none.errors is None and none.gradients is None
    model = uvol.Interpolator(linear, field="f")
    assert np.array_equal(model(linear)[0], model(linear.points)[0], equal_nan=True)


def test_the_tool_writes_the_same_answers(tmp_path, run_tool, linear):
    linear.save(tmp_path / "samples.csv")
    queries = uvol.Samples(np.random.default_rng(13).random((50, 3)) + [5e5, 4e6, 0], {"f": np.zeros(50)})
    queries.save(tmp_path / "queries.csv")
    run_tool("uvol_probe", "samples.csv", "tool.csv", "-points", "queries.csv", "-field", "f", "-model", "kriging")
    interpolator = uvol.Interpolator(uvol.read(tmp_path / "samples.csv"), field="f", model="kriging", gradients=False)
    interpolator.probe(uvol.read(tmp_path / "queries.csv")).save(tmp_path / "module.csv")
    assert (tmp_path / "module.csv").read_bytes() == (tmp_path / "tool.csv").read_bytes()


def test_the_tool_has_the_same_slices(tmp_path, run_tool, linear):
    linear.save(tmp_path / "samples.ply")
    run_tool("uvol_probe", "samples.ply", "tool.csv", "-plane", "z=0.5", "-size", "20", "-field", "f")
    tool = uvol.read(tmp_path / "tool.csv")
    lattice = uvol.Interpolator(linear, field="f").slice("z=0.5", 20)
    assert np.array_equal(lattice["f"].ravel(), tool["f"], equal_nan=True)
    assert np.array_equal(lattice["support"].ravel(), tool["support"])
    assert np.allclose(lattice.points.reshape(-1, 3), tool.points, atol=1e-3)


@pytest.mark.parametrize("model", ["fit", "kriging", "auto"])
def test_fields_in_boxes_that_repeat_are_those_of_the_tool(tmp_path, run_tool, model):
    points = np.random.default_rng(3).random((3000, 3)) + [7, 0, 0]
    uvol.Samples(points, {"f": np.sin(2 * np.pi * points).sum(axis=1)}).save(tmp_path / "in.ply")
    queries = uvol.Samples(np.random.default_rng(4).uniform([5, 0, 5], [9, 1, 9], (40, 3)))
    queries.save(tmp_path / "queries.ply")
    options = ["-field", "f,|grad(f)|", "-model", model, "-periodic", "1,0,1"]
    run_tool("uvol_probe", "in.ply", "tool.ply", "-points", "queries.ply", "-gradients", *options)
    run_tool("uvol_probe", "in.ply", "grid.ply", "-grid", "5", *options)
    told = json.loads(run_tool("uvol_probe", "in.ply", "-validate", "3", "-json", *options))["validation"]
    interpolator = uvol.Interpolator(uvol.read(tmp_path / "in.ply"), field=["f", "|grad(f)|"], model=model,
                                     periodic=(1, 0, 1))
    interpolator.probe(uvol.read(tmp_path / "queries.ply")).save(tmp_path / "module.ply")
    assert (tmp_path / "module.ply").read_bytes() == (tmp_path / "tool.ply").read_bytes()
    grid, tool = interpolator.grid(5), uvol.read(tmp_path / "grid.ply")
    assert np.allclose(grid.points.reshape(-1, 3), tool.points, atol=1e-6)
    for name in ("f", "|grad(f)|"):
        assert np.array_equal(grid[name].ravel().astype(tool[name].dtype), tool[name], equal_nan=True)
    assert told["f"]["rms"] == interpolator.validate(3)["f"]["rms"]
    assert len(interpolator.samples) == 3000 and "3000 points" in repr(interpolator)
    again = pickle.loads(pickle.dumps(interpolator))
    assert np.array_equal(again([[7.01, 0.5, 0.5], [8.01, 0.5, 0.5]])[0][:, 0], again([[9.01, 0.5, 0.5]] * 2)[0][:, 0])


def test_lattices_beyond_the_faces_are_those_of_the_tool(tmp_path, run_tool):
    points = np.random.default_rng(3).random((3000, 3)) + [7.3, 0, 0]
    uvol.Samples(points, {"f": np.sin(2 * np.pi * points).sum(axis=1)}).save(tmp_path / "in.ply")
    options = ["-field", "f,|grad(f)|", "-periodic", "1,1,1", "-gradients", "-box", "5.6,-1,-0.4,9.1,2,1.7"]
    run_tool("uvol_probe", "in.ply", "grid.vti", "-grid", "7", *options)
    run_tool("uvol_probe", "in.ply", "slice.vts", "-plane", "7.5,0.5,0.5,1,2,3", "-size", "20", *options)
    interpolator = uvol.Interpolator(uvol.read(tmp_path / "in.ply"), field=["f", "|grad(f)|"], periodic=(1, 1, 1))
    box = [5.6, -1, -0.4], [9.1, 2, 1.7]
    grid, cut = interpolator.grid(7, box), interpolator.slice(([7.5, 0.5, 0.5], [1, 2, 3]), 20, box)
    for lattice, name in ((grid, "grid.vti"), (cut, "slice.vts")):
        assert (lattice["support"] <= 2).all()
        lattice.save(tmp_path / f"module_{name}")
        assert (tmp_path / f"module_{name}").read_bytes() == (tmp_path / name).read_bytes()


def test_colors_of_slices_do_not_go_by_images(tmp_path, run_tool):
    random = np.random.default_rng(8)
    uvol.Samples(random.random((100, 3)), {"f": random.standard_normal(100)}).save(tmp_path / "in.ply")
    run_tool("uvol_probe", "in.ply", "tool.vti", "-plane", "z=0.5", "-size", "60", "-field", "laplacian(f)", "-periodic", "1,1,1",
             "-png", "tool.png")
    cut = uvol.Interpolator(uvol.read(tmp_path / "in.ply"), field="laplacian(f)", periodic=(1, 1, 1)).slice("z=0.5", 60)
    cut.render().save(tmp_path / "module.png")
    assert pixels_of(tmp_path / "module.png") == pixels_of(tmp_path / "tool.png")


@pytest.mark.parametrize("plane, options, asked", [
    ("z=0.5", [], {}),
    ("x=500000.5", ["-samples", "0.05"], {"samples": 0.05}),
    ("500000.5,4000000.5,0.5,1,2,3", ["-contours", "0.5,1", "-unit", "km", "-colormap", "cividis", "-range", "0,2", "-label", "height"],
     {"contours": [0.5, 1], "unit": "km", "colormap": "cividis", "range": (0, 2), "label": "height"}),
])
def test_the_tool_draws_the_same_slices(tmp_path, run_tool, linear, plane, options, asked):
    linear.save(tmp_path / "samples.ply")
    run_tool("uvol_probe", "samples.ply", "tool.vti", "-plane", plane, "-size", "60", "-field", "f", "-png", "tool.png", *options)
    numbers = [float(number) for number in plane.split(",")] if "," in plane else []
    place = (numbers[:3], numbers[3:]) if numbers else plane
    lattice = uvol.Interpolator(linear, field="f").slice(place, 60)
    lattice.render("f", **asked).save(tmp_path / "module.png")
    assert pixels_of(tmp_path / "module.png") == pixels_of(tmp_path / "tool.png")
    assert lattice._repr_png_().startswith(b"\x89PNG")


def test_the_tool_draws_the_same_lines(tmp_path, run_tool, linear):
    linear.save(tmp_path / "samples.ply")
    run_tool("uvol_probe", "samples.ply", "tool.csv", "-line", "500000.1,4000000.1,0.1,500000.8,4000000.9,0.7", "-n", "40", "-field", "f", "-model", "nearest",
             "-png", "tool.png")
    line = uvol.Interpolator(linear, field="f", model="nearest").line([500000.1, 4000000.1, 0.1], [500000.8, 4000000.9, 0.7], 40)
    line.render().save(tmp_path / "module.png")
    assert pixels_of(tmp_path / "module.png") == pixels_of(tmp_path / "tool.png")


def test_grids_and_gradients_are_not_drawn(linear):
    interpolator = uvol.Interpolator(linear, field="f")
    with pytest.raises(ValueError, match="along a line or in a slice"):
        interpolator.grid(4).render()
    with pytest.raises(ValueError, match="one number per place"):
        interpolator.slice("z=0.5", 4).render("f_gradient")
    with pytest.raises(KeyError, match="g"):
        interpolator.slice("z=0.5", 4).render("g")
    assert interpolator.grid(4)._repr_png_() is None


def test_variograms_are_those_of_the_tool(tmp_path, run_tool, linear):
    linear.save(tmp_path / "samples.ply")
    told = json.loads(run_tool("uvol_probe", "samples.ply", "-model", "kriging", "-field", "f,g", "-variogram-csv", "v.csv", "-json"))
    with warns("no_variogram") as warned:
        interpolator = uvol.Interpolator(linear, field=["f", "g"], model="kriging")
        interpolator([5e5 + 0.5, 4e6 + 0.5, 0.5])
    assert {"field": "g"} in [warning.message.values for warning in warned if warning.message.code == "no_variogram"]
    assert list(interpolator.variograms) == list(told["variograms"]) == ["f"]
    found, by_tool = interpolator.variograms["f"], told["variograms"]["f"]
    assert found["kind"] == by_tool["kind"]
    assert [found[key] for key in ("nugget", "psill", "range")] == pytest.approx([by_tool[key] for key in ("nugget", "psill", "range")])
    table = np.genfromtxt(tmp_path / "v.csv", delimiter=",", names=True, dtype=None, encoding=None)
    rows = table[table["direction"] == "all"]
    assert np.allclose(rows["distance"], interpolator.variograms["f"]["distances"])
    assert np.allclose(rows["half_mean_square"], interpolator.variograms["f"]["values"])
    assert np.array_equal(rows["pairs"], interpolator.variograms["f"]["pairs"])
    assert uvol.Interpolator(linear, field="f").variograms == {}


@pytest.mark.parametrize("ending", ["vti", "vts", "nrrd", "mha"])
def test_the_tool_writes_the_same_grids(tmp_path, run_tool, linear, ending):
    linear.save(tmp_path / "samples.ply")
    (tmp_path / "tool").mkdir()
    (tmp_path / "module").mkdir()
    run_tool("uvol_probe", "samples.ply", f"tool/grid.{ending}", "-grid", "9", "-field", "f,g", "-gradients")
    grid = uvol.Interpolator(uvol.read(tmp_path / "samples.ply"), field=["f", "g"]).grid(9)
    grid.save(tmp_path / "module" / f"grid.{ending}")
    written = sorted(path.name for path in (tmp_path / "tool").iterdir())
    assert written == sorted(path.name for path in (tmp_path / "module").iterdir())
    for name in written:
        assert (tmp_path / "module" / name).read_bytes() == (tmp_path / "tool" / name).read_bytes()
    with pytest.raises(ValueError, match=".vti, .vts"):
        grid.save(tmp_path / "grid.png")


def test_places_beside_which_the_extent_is_beyond_measure_have_the_nearest_value():
    random = np.random.default_rng(5)
    for _ in range(50):
        points = random.standard_normal((40, 3))
        points[random.random((40, 3)) < 0.3] = 3e38
        values = random.integers(0, 5, 40).astype(float)
        model = uvol.Interpolator(points, {"a": values}, model="natural", extrapolate=True, threads=1)
        found = model.evaluate(points + random.standard_normal((40, 3)) * 1e-3).values
        assert not np.any((found < 0) | (found > 4))


def test_validation_reports_errors(linear):
    scores = uvol.Interpolator(linear, field=["f", "g"]).validate(5, by="blocks")
    assert list(scores) == ["f", "g"] and scores["f"]["tested"] == 2000 and scores["f"]["rms"] < 1e-3
    with raises(ValueError, "folds_not_allowed", {"folds": 1}):
        uvol.Interpolator(linear, field="f").validate(1)
    with raises(KeyError, "unknown_field", {"field": "hole"}):
        uvol.Interpolator(linear, field="f").validate(2, by="hole")


def test_lattices(linear):
    interpolator = uvol.Interpolator(linear, field="f")
    grid = interpolator.grid((4, 3, 2))
    assert grid["f"].shape == (2, 3, 4) and grid["f_gradient"].shape == (2, 3, 4, 3)
    assert (np.diff(grid.points[0, 0, :, 0]) > 0).all() and (np.diff(grid.points[:, 0, 0, 2]) > 0).all()
    assert max(interpolator.grid(5).shape) == 5
    line = interpolator.line([5e5, 4e6, 0.5], [5e5 + 1, 4e6 + 1, 0.5], n=7)
    assert line["f"].shape == (7,)
    oblique = interpolator.slice(([5e5 + 0.5, 4e6 + 0.5, 0.5], [1, 1, 1]), 9)
    assert max(oblique.shape) == 9
    with pytest.raises(KeyError, match="did you mean"):
        grid["f_eror"]


def test_grids_become_datasets_of_xarray(linear):
    pytest.importorskip("xarray")
    interpolator = uvol.Interpolator(linear, field="f")
    data = interpolator.grid((4, 3, 2)).to_xarray()
    assert data["f"].dims == ("z", "y", "x") and data["f_gradient"].dims == ("z", "y", "x", "axis")
    inner = data.isel(x=1, y=1, z=0)
    expected = float(inner.x - 5e5) + 2 * float(inner.y - 4e6) + 3 * float(inner.z)
    assert np.isnan(inner.f) or abs(float(inner.f) - expected) < 1e-2
    oblique = interpolator.slice(([5e5 + 0.5, 4e6 + 0.5, 0.5], [1, 1, 1]), 9).to_xarray()
    assert oblique["f"].dims == ("k", "j") or oblique["f"].dims == ("j", "i")


def test_queries_outside_are_a_warning(linear):
    with pytest.warns(uvol.ResultWarning) as warned:
        values, _ = uvol.Interpolator(linear, field="f")(np.zeros((20, 3)))
    assert "queries_outside" in [warning.message.code for warning in warned]
    assert np.isnan(values).all()


def test_pickled_models_answer_the_same(linear):
    interpolator = uvol.Interpolator(linear, field=["f", "f*g"], model="shepard", shepard={"k": 5})
    queries = np.random.default_rng(3).random((20, 3)) + [5e5, 4e6, 0]
    again = pickle.loads(pickle.dumps(interpolator))
    assert np.array_equal(again(queries)[0], interpolator(queries)[0], equal_nan=True)


def test_threads_may_ask_at_once(linear):
    interpolator = uvol.Interpolator(linear, field="f", threads=1)
    queries = np.random.default_rng(3).random((500, 3)) + [5e5, 4e6, 0]
    expected = interpolator(queries)[0]
    found = [None] * 8

    def ask(number):
        found[number] = interpolator(queries)[0]

    workers = [threading.Thread(target=ask, args=[number]) for number in range(8)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert all(np.array_equal(values, expected, equal_nan=True) for values in found)


@pytest.mark.parametrize("options, code, values", [
    (dict(model="spline"), "wrong_parameter", {"name": "model", "value": '"spline"'}),
    (dict(kriging={"nugget": -1}, model="kriging"), "interpolation_number", {"number": "nugget", "value": -1}),
    (dict(kriging={"nuget": 1}), "unknown_parameter", {"name": "kriging.nuget", "similar": "nugget"}),
    (dict(field="q"), "unknown_lone_field", {"field": "q"}),
    (dict(scale=[1, 0, 1]), "interpolation_number", {"number": "scale", "value": 0}),
])
def test_mistakes_get_a_sentence(linear, options, code, values):
    with raises((ValueError, KeyError), code, values):
        uvol.Interpolator(linear, **{"field": "f", **options})


@pytest.mark.parametrize("call, expected", [
    (lambda i: i(np.zeros((3, 2))), dict(match="must be")),
    (lambda i: i([["a", "b", "c"]]), dict(match="numbers")),
    (lambda i: i.slice("w=1"), dict(match="must be x=")),
    (lambda i: i.slice("z=deep"), dict(match="must be x=")),
    (lambda i: i.slice("z=nan"), dict(match="must be x=")),
    (lambda i: i.slice("z=99"), dict(code="plane_misses_data")),
    (lambda i: i.grid(1), dict(code="few_points_of_grid")),
    (lambda i: i.grid((3, 3)), dict(match="must be one, or three")),
    (lambda i: i.line([0, 0], [1, 1, 1]), dict(match="three")),
    (lambda i: i.grid(5, box=[0, 0, 0]), dict(match="pair")),
])
def test_queries_that_are_none_get_a_sentence(linear, call, expected):
    with raises(ValueError, **expected):
        call(uvol.Interpolator(linear, field="f"))


@pytest.mark.parametrize("call, message", [
    (lambda i: i.slice("z=0.5", (1, 2, 3)), "size has 3 numbers"),
    (lambda i: i.slice("z=0.5", box=3), "box is a pair"),
    (lambda i: i.slice("z=0.5", 8).render(range=3), "the lower one first"),
    (lambda i: i.slice("z=0.5", 8).render(range=(2, 1)), "the lower one first"),
    (lambda i: i.slice("z=0.5", 8).render(range=(0, 1), log=True), "above 0"),
    (lambda i: i.slice("z=0.5", 8).render(samples=-1), "distance from 0"),
    (lambda i: i.slice("z=0.5", 8).render(contours="a"), "contours is 'a'"),
    (lambda i: i.slice("z=0.5", 8).render("g"), "no field 'g'"),
    (lambda i: i.line([0, 0], [1, 1, 1]), "start has 2 numbers"),
])
def test_places_that_are_none_get_a_sentence(linear, call, message):
    with pytest.raises((ValueError, KeyError), match=message):
        call(uvol.Interpolator(linear, field="f"))


@pytest.fixture
def notched(tmp_path):
    """A file of cubes in [0, 8]^3, but for those in [4, 8]^3, with the field f = x + 2 y + 3 z at all corners."""
    corners = np.stack(np.meshgrid(*[np.arange(9)] * 3, indexing="ij"), -1)[..., ::-1].reshape(-1, 3)
    low = np.stack(np.meshgrid(*[np.arange(8)] * 3, indexing="ij"), -1)[..., ::-1].reshape(-1, 3)
    low = low[~(low >= 4).all(axis=1)]
    offsets = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
    cells = (low[:, None] + offsets) @ [1, 9, 81]
    lines = ["# vtk DataFile Version 3.0", "notched", "ASCII", "DATASET UNSTRUCTURED_GRID", f"POINTS {len(corners)} float"]
    lines += [" ".join(map(str, corner)) for corner in corners]
    lines += [f"CELLS {len(cells)} {9 * len(cells)}"] + ["8 " + " ".join(map(str, cell)) for cell in cells]
    lines += [f"CELL_TYPES {len(cells)}"] + ["12"] * len(cells)
    lines += [f"POINT_DATA {len(corners)}", "SCALARS f float", "LOOKUP_TABLE default"]
    lines += [str(value) for value in corners @ [1, 2, 3]]
    path = tmp_path / "notched.vtk"
    path.write_text("\n".join(lines) + "\n")
    return path


def test_cells_of_a_file_say_where_the_data_are(notched):
    places = [[1.5, 2.5, 3.5], [7.5, 7.5, 0.1], [6.5, 6.5, 6.5]]
    samples = uvol.read(notched)
    interpolator = uvol.Interpolator(samples, field="f")
    answers = interpolator.evaluate(places)
    assert np.allclose(answers.values, [17, 22.8, np.nan], atol=1e-5, equal_nan=True)
    assert answers.support[2] == 7
    assert np.isnan(pickle.loads(pickle.dumps(interpolator)).evaluate(places).values[2])
    assert np.allclose(uvol.Interpolator(samples, field="f", cell_mask=False).evaluate(places).values, [17, 22.8, 39], atol=1e-5)
    for same in samples.compute("2*f"), uvol.Samples(samples), pickle.loads(pickle.dumps(samples)):
        assert np.isnan(uvol.Interpolator(same, field="f").evaluate(places).values[2])
    assert np.allclose(uvol.Interpolator(samples.where("f < 100"), field="f").evaluate(places).values[2], 39, atol=1e-5)


def test_changed_cells_of_a_file_are_reported(notched, monkeypatch):
    monkeypatch.chdir(notched.parent)
    samples = uvol.read(notched.name)
    monkeypatch.chdir("/")
    assert np.isnan(uvol.Interpolator(samples, field="f").evaluate([[6.5, 6.5, 6.5]]).values[0])
    samples = uvol.read(notched)
    notched.write_text(notched.read_text() + "\n")
    for _ in range(2):
        with pytest.warns(uvol.ResultWarning) as warned:
            interpolator = uvol.Interpolator(samples, field="f")
        assert "cells_not_used" in [warning.message.code for warning in warned]
    assert np.isfinite(interpolator.evaluate([[6.5, 6.5, 6.5]]).values[0])
