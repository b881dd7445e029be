# SPDX-License-Identifier: BSD-3-Clause
"""Isosurfaces from Python: the tool's own, byte for byte; errors, warnings, progress, threads."""

import json
import pickle
import re
import signal
import sys
import threading
import time
import types
import warnings

import numpy as np
import pytest
from conftest import raises, warns

import pcl_uvol as uvol


def test_isopoints_lie_on_the_sphere(sphere):
    offsets = sphere.points - 0.5
    misses = np.abs(np.linalg.norm(offsets, axis=1) - 0.3)
    assert misses.max() < 1e-2 and np.median(misses) < 2e-4
    inwards = -offsets / np.linalg.norm(offsets, axis=1)[:, None]
    cosines = np.sum(sphere.normals * -inwards, axis=1)
    assert cosines.min() > 0.5 and np.median(cosines) > 0.9999
    assert sphere["vel"].shape == sphere.points.shape
    assert sphere["id"].dtype == np.int32
    assert len(sphere) == sphere.report["isopoints"][0] == sphere.report["counts"]["isopoints"]
    assert sphere.report["error"]["median"] < 2e-3


OPTIONS = [
    (dict(iso=0.3), ["-iso", "0.3"]),
    (dict(iso=[0.2, 0.4], interpolation="linear", normals="pca"),
     ["-iso", "0.2,0.4", "-interpolation", "linear", "-normals", "pca"]),
    (dict(iso=0.3, outside="higher", criterion="all", scale=(1, 2, 1)),
     ["-iso", "0.3", "-outside", "higher", "-criterion", "all", "-scale", "1,2,1"]),
    (dict(iso=0.3, scale=(1, 1, 2), rotate=(20, 30, -10)),
     ["-iso", "0.3", "-scale", "1,1,2", "-rotate", "20,30,-10"]),
    (dict(iso=0.3, scale=[[1, 0, 0], [0, 2, 0], [0, 0.5, 1]]), ["-iso", "0.3", "-scale", "1,0,0,0,2,0,0,0.5,1"]),
    (dict(iso=0.3, scale="spacing", rotate=(0, 5, 0)), ["-iso", "0.3", "-scale", "spacing", "-rotate", "0,5,0"]),
    (dict(iso=0.3, fill_gaps=True), ["-iso", "0.3", "-fill-gaps"]),
    (dict(iso=0.3, smooth=True, mu=0.4), ["-iso", "0.3", "-smooth", "-mu", "0.4"]),
    (dict(iso=0.3, scale="auto", max_error=0.001, neighbors="voronoi", voronoi_cells=30),
     ["-iso", "0.3", "-scale", "auto", "-max-error", "0.001", "-neighbors", "voronoi", "-grid", "30"]),
    (dict(iso=0.3, max_error="auto"), ["-iso", "0.3", "-max-error", "auto"]),
    (dict(iso=0.3, periodic=(1.5, 0, 1)), ["-iso", "0.3", "-periodic", "1.5,0,1"]),
    (dict(iso=0.09, field="r*r"), ["-iso", "0.09", "-field", "r*r"]),
]


@pytest.mark.parametrize("options, arguments", OPTIONS)
def test_the_tool_writes_the_same_bytes(tmp_path, run_tool, ball, options, arguments):
    samples = uvol.Samples(*ball)
    samples.save(tmp_path / "samples.ply")
    options = {"field": "r", **options}
    arguments = arguments if "-field" in arguments else [*arguments, "-field", "r"]
    run_tool("uvol_isosurface", "samples.ply", "tool.ply", *arguments)
    uvol.isosurface(uvol.read(tmp_path / "samples.ply"), **options).save(tmp_path / "module.ply")
    assert (tmp_path / "module.ply").read_bytes() == (tmp_path / "tool.ply").read_bytes()


@pytest.mark.parametrize("field, iso", [("|grad(f)|", 8), ("laplacian(f)*f", -40), ("f+x", 8)])
def test_derivatives_see_across_the_faces_as_those_of_the_tool(tmp_path, run_tool, field, iso):
    points = np.random.default_rng(3).random((3000, 3)) + [7, 0, 0]
    uvol.Samples(points, {"f": np.sin(2 * np.pi * points).sum(axis=1)}).save(tmp_path / "samples.ply")
    run_tool("uvol_isosurface", "samples.ply", "tool.ply", "-field", field, "-iso", iso, "-periodic", "1,0,1")
    extractor = uvol.Extractor(uvol.read(tmp_path / "samples.ply"))
    alone = extractor.extract(field=field, iso=iso)
    extractor.extract(field=field, iso=iso, periodic=(1, 0, 1)).save(tmp_path / "module.ply")
    assert (tmp_path / "module.ply").read_bytes() == (tmp_path / "tool.ply").read_bytes()
    assert extractor.extract(field=field, iso=iso).records.tobytes() == alone.records.tobytes()


def test_coordinates_beside_a_derivative_are_those_of_the_samples():
    points = np.random.default_rng(3).random((3000, 3))
    samples = uvol.Samples(points, {"f": np.sin(2 * np.pi * points).sum(axis=1)})
    for iso in (0.1, 0.3, 0.9):
        alone = uvol.isosurface(samples, field="x+0", iso=iso, periodic=(1, 1, 1))
        beside = uvol.isosurface(samples, field="x+0*|grad(f)|", iso=iso, periodic=(1, 1, 1))
        assert len(alone) > 100 and np.array_equal(alone.points, beside.points)


def test_images_of_a_welded_mesh_close_it(tmp_path, run_tool):
    points = np.random.default_rng(3).random((4000, 3))
    samples = uvol.Samples(points, {"f": np.sin(2 * np.pi * points).sum(axis=1)})
    samples.save(tmp_path / "samples.ply")
    options = ["-field", "f", "-iso", "0.3", "-mesh", "-periodic", "1,1,1", "-periodic-mesh", "weld"]
    run_tool("uvol_isosurface", "samples.ply", "tool.ply", *options)
    mesh = uvol.isosurface(uvol.read(tmp_path / "samples.ply"), field="f", iso=0.3, mesh=True, periodic=(1, 1, 1),
                           periodic_mesh="weld")
    mesh.save(tmp_path / "module.ply")
    assert (tmp_path / "module.ply").read_bytes() == (tmp_path / "tool.ply").read_bytes()
    a, b, c = mesh["image_of"][mesh.triangles].T
    edges = {*zip(a, b), *zip(b, c), *zip(c, a)}
    assert len(edges) == 3 * len(mesh.triangles) and all((to, start) in edges for start, to in edges)
    with raises(ValueError, "nothing_to_weld"):
        uvol.isosurface(samples, field="f", iso=0.3, periodic_mesh="weld")
    with raises(ValueError, "wrong_parameter", {"name": "periodic_mesh", "value": '"sew"'}):
        uvol.isosurface(samples, field="f", iso=0.3, mesh=True, periodic=(1, 1, 1), periodic_mesh="sew")


@pytest.mark.parametrize("ending", ["ply", "obj", "stl"])
def test_the_tool_writes_the_same_mesh(tmp_path, run_tool, ball, ending):
    uvol.Samples(*ball).save(tmp_path / "samples.ply")
    run_tool("uvol_isosurface", "samples.ply", f"tool.{ending}", "-field", "r", "-iso", "0.3", "-mesh")
    surface = uvol.isosurface(uvol.read(tmp_path / "samples.ply"), field="r", iso=0.3)
    surface.mesh().save(tmp_path / f"module.{ending}")
    assert (tmp_path / f"module.{ending}").read_bytes() == (tmp_path / f"tool.{ending}").read_bytes()


def test_a_mesh_is_read_as_it_was_written(tmp_path, sphere):
    mesh = sphere.mesh()
    mesh.save(tmp_path / "mesh.ply")
    vertices, triangles = uvol.read_mesh(tmp_path / "mesh.ply")
    assert np.array_equal(triangles, mesh.triangles) and np.array_equal(vertices.points, mesh.points)
    assert np.array_equal(vertices["vel_1"], mesh["vel"][:, 1])  # ply has no fields of several numbers


def test_nothing_of_a_surface_is_copied(ball):
    points, fields = ball
    mesh = uvol.isosurface(points.astype(np.float32), fields, field="r", iso=0.3, mesh=True)
    for array in (mesh.points, mesh.normals, mesh["vel"], mesh["error"]):
        assert np.shares_memory(array, mesh.records) and not array.flags.writeable
    assert not mesh.triangles.flags.owndata and not mesh.triangles.flags.writeable


def test_meshes_are_asked_for_with_booleans_of_any_kind(ball):
    for mesh, kind in ((None, uvol.Surface), (np.False_, uvol.Surface), (np.True_, uvol.Mesh), ({}, uvol.Mesh)):
        assert type(uvol.isosurface(*ball, field="r", iso=0.3, mesh=mesh)) is kind


def test_a_mesh_is_closed(sphere):
    mesh = sphere.mesh()
    edges = np.concatenate([mesh.triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])])
    forward = {tuple(edge) for edge in edges.tolist()}
    assert len(forward) == len(edges) and {edge[::-1] for edge in forward} == forward
    assert [piece["genus"] for piece in mesh.report["pieces"]] == [0]
    assert len(mesh.vertices) - len(edges) // 2 + len(mesh.triangles) == 2


def test_threads_do_not_change_a_byte(ball):
    records = [uvol.isosurface(*ball, field="r", iso=0.3, threads=threads).records.tobytes() for threads in (1, 2, 5)]
    assert records[0] == records[1] == records[2]


def test_an_extractor_serves_several_isovalues_and_fields(ball):
    extractor = uvol.Extractor(*ball)
    for options in (dict(iso=0.2), dict(iso=0.3), dict(iso=0.1, field="|vel|"), dict(iso=0.3)):
        options = {"field": "r", **options}
        again = uvol.isosurface(*ball, **options)
        assert extractor.extract(**options).records.tobytes() == again.records.tobytes()
    assert repr(extractor).startswith("Extractor of Samples of 4000 points: r (float64)")


def test_points_of_tables_and_surfaces_are_samples(ball, sphere):
    pandas = pytest.importorskip("pandas")
    points, fields = ball
    frame = pandas.DataFrame(points, columns=list("xyz")).assign(r=fields["r"])
    for table in (frame, uvol.Samples(frame), frame.to_xarray()):
        surface = uvol.isosurface(table, field="r", iso=0.3, outside="higher")
        assert np.array_equal(surface.points, sphere.points)


def test_pickled_surfaces_are_the_same(sphere):
    for surface in (sphere, sphere.mesh()):
        again = pickle.loads(pickle.dumps(surface))
        assert again.records.tobytes() == surface.records.tobytes()
        assert again.report == surface.report and type(again) is type(surface)
    assert np.array_equal(again.triangles, surface.triangles)
    with pytest.raises(ValueError, match="lost its samples"):
        again.mesh()
    extractor = pickle.loads(pickle.dumps(uvol.Extractor(sphere)))
    assert extractor.samples.records.tobytes() == sphere.records.tobytes()


def test_no_isopoints_are_a_warning(ball):
    with warns("no_isopoints") as warned:
        surface = uvol.isosurface(*ball, field="r", iso=7.0)
    assert len(surface) == 0 and surface.points.shape == (0, 3) and surface.normals.shape == (0, 3)
    told, warning = surface.report["warnings"][0], warned[0].message
    assert told["code"] == warning.code == "no_isopoints" and told["values"] == warning.values
    assert warning.values["isovalue"] == "7" and warning.values["field"] == "r"
    assert "0 points" in repr(surface) and surface._repr_png_() is None


def test_warnings_name_the_line_of_the_caller(ball):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        uvol.isosurface(*ball, field="r", iso=7.0)
    assert caught[0].filename == __file__


@pytest.mark.parametrize("options, error, expected", [
    (dict(field="vle", iso=1), KeyError, dict(code="unknown_lone_field", values={"field": "vle", "similar": "vel"})),
    (dict(field="log10(q)", iso=1), KeyError, dict(code="unknown_operand", values={"field": "q"})),
    (dict(field="r +", iso=1), ValueError, dict(code="operand_missing_at_end")),
    (dict(field="vel", iso=1), ValueError, dict(code="several_components", values={"name": "vel", "components": 3})),
    (dict(field=5, iso=1), TypeError, dict(match="field is 5")),
    (dict(field="r"), TypeError, dict(match="iso")),
    (dict(field="r", iso=[]), ValueError, dict(match=r"iso is \[\]: it must be")),
    (dict(field="r", iso=np.nan), ValueError, dict(match="iso is nan")),
    (dict(field="r", iso="0.3"), ValueError, dict(match="iso is '0.3'")),
    (dict(field="r", iso=np.ma.masked), ValueError, dict(match="iso is masked")),
    (dict(field="r", iso=np.ma.array([0.2, 0.3], mask=[False, True])), ValueError, dict(match="iso is")),
    (dict(field="r", iso=[0.3, 0.2, 0.3]), ValueError, dict(code="repeated_isovalue", values={"isovalue": "0.3"})),
    (dict(field="r", iso=1, scale=[[1, 2], [3]]), ValueError, dict(match=r"scale is \[\[1, 2\], \[3\]\]")),
    (dict(field="r", iso=1, mesh="even"), TypeError, dict(match="mesh is 'even'")),
    (dict(field="r", iso=1, izo=2), TypeError, dict(match="izo")),
    (dict(field="r", iso=1, outside="up"), ValueError,
     dict(code="wrong_parameter", values={"name": "isosurface.outside", "value": '"up"'})),
    (dict(field="r", iso=1, scale=(1, 1)), ValueError, dict(match="scale has 2")),
    (dict(field="r", iso=1, rotate=(1, 1)), ValueError, dict(match="rotate has 2")),
    (dict(field="r", iso=1, rotate=(0, 10, 20)), ValueError, dict(code="plunge_too_steep", values={"plunge": 20, "dip": 10})),
    (dict(field="r", iso=1, scale=np.eye(3), rotate=(0, 1, 0)), ValueError, dict(match="without rotate")),
    (dict(field="r", iso=1, scale=(1, 1, -1)), ValueError, dict(code="scale_not_positive")),
    (dict(field="r", iso=1, scale="automatic"), ValueError, dict(match="scale is 'automatic'")),
    (dict(field="r", iso=1, threads=-1), ValueError, dict(match="threads is -1")),
    (dict(field="r", iso=1, threads=1.5), TypeError, dict(match="threads is 1.5")),
    (dict(field="r", iso=1, normal_neighbors=1), ValueError, dict(code="few_normal_neighbors", values={"neighbors": 1})),
    (dict(field="r", iso=1, max_error=-1), ValueError, dict(code="largest_error_not_allowed", values={"error": -1})),
    (dict(field="r", iso=1, validate=1), ValueError, dict(code="hold_out_of_one_fold")),
    (dict(field="r", iso=1, level_set={"speed": 1}), ValueError,
     dict(code="unknown_parameter", values={"name": "level_set.speed"})),
    (dict(field="r", iso=1, level_set={"mu": object()}), ValueError, dict(match="parameter")),
    (dict(field="r", iso=1, mesh={"edges": 1}), ValueError, dict(code="unknown_parameter", values={"name": "mesh.edges"})),
    (dict(field="r", iso=1, progress=5), TypeError, dict(match="progress is True or a function")),
])
def test_mistakes_get_a_sentence(ball, options, error, expected):
    with raises(error, **expected):
        uvol.isosurface(*ball, **options)


@pytest.mark.parametrize("points, fields, code", [
    (np.empty((0, 3)), {"r": []}, "empty_cloud"),
    (np.full((20, 3), np.nan), {"r": np.ones(20)}, "no_usable_sample"),
    (np.random.default_rng(1).random((20, 3)), {"r": np.full(20, np.nan)}, "no_finite_value"),
])
def test_samples_without_a_value_get_a_sentence(points, fields, code):
    with raises(ValueError, code):
        uvol.isosurface(points, fields, iso=0.5)


def test_progress_is_reported_and_may_end_the_work(ball):
    told = []
    random = np.random.default_rng(3)
    points = random.random((60000, 3))
    uvol.isosurface(points, {"r": points[:, 0]}, iso=0.5, progress=lambda step, done: told.append((step, done)))
    assert told and all(isinstance(step, str) and 0 <= done <= 1 for step, done in told)

    def stop(step, done):
        raise RuntimeError("enough")

    extractor = uvol.Extractor(points, {"r": points[:, 0]})
    with pytest.raises(RuntimeError, match="enough"):
        extractor.extract(iso=0.5, progress=stop)
    assert len(extractor.extract(iso=0.5)) > 100


def test_a_bar_shows_progress(ball, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)  # as if it were not installed
    uvol.isosurface(*ball, field="r", iso=0.3, smooth=True, progress=True)
    assert re.search(r"\r\w+ .* \d+ %", capsys.readouterr().err)


def test_a_bar_is_that_of_tqdm_where_it_is_installed(ball, monkeypatch):
    bars = []

    class Bar:
        def __init__(self, total, desc, **options):
            self.total, self.desc, self.n, self.ended = total, desc, 0, False
            bars.append(self)

        def refresh(self):
            assert 0 <= self.n <= self.total and not self.ended

        def close(self):
            self.ended = True

    monkeypatch.setitem(sys.modules, "tqdm", types.SimpleNamespace())
    monkeypatch.setitem(sys.modules, "tqdm.auto", types.SimpleNamespace(tqdm=Bar))
    uvol.isosurface(*ball, field="r", iso=0.3, smooth=True, progress=True)
    assert bars and all(bar.ended and bar.desc for bar in bars)


def test_ctrl_c_ends_a_long_step_and_leaves_the_object_usable(ball):
    random = np.random.default_rng(3)
    points = random.random((200000, 3))
    noisy = np.linalg.norm(points - 0.5, axis=1) + 0.05 * random.standard_normal(len(points))
    extractor = uvol.Extractor(points, {"r": noisy})
    timer = threading.Timer(0.3, signal.raise_signal, [signal.SIGINT])
    timer.start()
    start = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        extractor.extract(iso=0.3, smooth=True)
    assert time.perf_counter() - start < 30.0  # the smoothing takes longer by far
    assert len(extractor.extract(iso=0.3, interpolation="linear")) > 100


def test_eight_threads_at_once(ball):
    expected = uvol.isosurface(*ball, field="r", iso=0.3).records.tobytes()
    samples = uvol.Samples(*ball)
    extractor = uvol.Extractor(samples)
    found = [None] * 8

    def extract(number):
        mine = extractor if number % 2 else uvol.Extractor(samples)
        found[number] = mine.extract(field="r", iso=0.3, threads=1).records.tobytes()

    workers = [threading.Thread(target=extract, args=[number]) for number in range(8)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert found == [expected] * 8


def test_measures_of_a_sphere(sphere):
    figures = sphere.measure(find_intersections=True)
    area, volume = 4 * np.pi * 0.3**2, 4 / 3 * np.pi * 0.3**3
    assert abs(figures.area.value - area) < max(1e-3 * area, figures.area.error)
    assert abs(figures.volume.value - volume) < max(1e-3 * volume, figures.volume.error)
    assert figures.genus == 0 and figures.rims == 0 and len(figures.pieces) == 1
    assert np.allclose(figures.centroid, 0.5, atol=1e-3)
    assert figures.report["intersections"] == 0
    assert np.isclose(figures.vertex_areas.sum(), figures.area.value)
    r = figures.inside["r"]  # of the distance to the centre: 3/4 of the radius
    assert abs(r.mean - 0.75 * 0.3) < 0.01
    assert "area" in repr(figures)


def test_flat_figures_are_those_of_the_triangles(sphere):
    mesh = sphere.mesh()
    assert float(mesh.measure().area) == float(sphere.measure().area)
    flat = mesh.measure(curved=False)
    corners = mesh.vertices[mesh.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert np.isclose(flat.area.value, np.linalg.norm(normals, axis=1).sum() / 2, rtol=1e-5)


@pytest.mark.parametrize("ending", ["ply", "obj", "stl"])
def test_surfaces_of_files_are_measured_as_the_tool_does(tmp_path, run_tool, sphere, ending):
    mesh = sphere.mesh()
    mesh.save(tmp_path / f"mesh.{ending}")
    sphere._samples.save(tmp_path / "samples.ply")
    told = json.loads(run_tool("uvol_measure", f"mesh.{ending}", "-json", "-samples", "samples.ply"))["surfaces"]
    samples = uvol.read(tmp_path / "samples.ply")
    figures = uvol.measure(uvol.read_mesh(tmp_path / f"mesh.{ending}"), samples=samples)
    assert figures.area.value == told["area"] and figures.volume.error == told["volume_error"]
    assert figures.samples == told["samples"] and figures.samples > 100
    assert mesh.measure().isovalue == 0.3


def test_points_are_measured_as_the_tool_does(tmp_path, run_tool, sphere):
    sphere.save(tmp_path / "points.ply")
    told = json.loads(run_tool("uvol_measure", "points.ply", "-json"))["surfaces"]
    figures = uvol.measure(uvol.read(tmp_path / "points.ply"))
    assert figures.area.value == told["area"] and figures.genus is None
    with raises(ValueError, "surface_without_normals"):
        uvol.measure(uvol.Samples(sphere.points))


def test_surfaces_are_compared_as_the_tool_does(tmp_path, run_tool, ball):
    points, fields = ball
    for name, iso in (("a", 0.3), ("b", 0.31)):
        uvol.isosurface(points, fields, field="r", iso=iso, outside="higher", mesh=True).save(tmp_path / f"{name}.ply")
    told = json.loads(run_tool("uvol_compare", "a.ply", "b.ply", "tool.ply", "-json"))
    a, b = (uvol.read_mesh(tmp_path / f"{name}.ply") for name in "ab")
    found = uvol.compare(a, b)
    for way, distances in (("a_to_b", found.forth), ("b_to_a", found.back)):
        assert told[way]["mean"] == distances.mean and told[way]["percentile_99_9"] == distances.percentile_99_9
        assert told["fields_" + way]["r"] == {"mean": distances.fields["r"].mean, "largest": distances.fields["r"].largest}
    assert told["largest_distance"] == found.largest and "largest 0.0" in repr(found)
    uvol.write(tmp_path / "module.ply", found.surface, triangles=a[1])
    assert (tmp_path / "module.ply").read_bytes() == (tmp_path / "tool.ply").read_bytes()
    with warns("no_triangles") as warned:
        assert np.isclose(uvol.compare(a, a[0]).back.largest, 0, atol=1e-6)
    assert [(warning.message.code, warning.message.values) for warning in warned] == [("no_triangles", {"surface": "b"})]


@pytest.mark.parametrize("triangles, message", [
    ([[0, 1]], r"shape \(1, 2\)"),
    ([[0, 1, 3]], "indices 0 to 3: there are 3 vertices"),
    ([[-1, 0, 1]], "indices -1 to 1"),
    ([[0.0, 1.0, 2.0]], "whole numbers"),
    ([["a", "b", "c"]], "must hold numbers"),
])
def test_triangles_that_are_none_get_a_sentence(tmp_path, triangles, message):
    for call in (lambda: uvol.measure((np.eye(3), triangles)), lambda: uvol.compare((np.eye(3), triangles), np.eye(3)),
                 lambda: uvol.write(tmp_path / "a.ply", np.eye(3), triangles=triangles)):
        with pytest.raises(ValueError, match=message):
            call()
    assert not (tmp_path / "a.ply").exists()


def test_a_file_names_the_box_that_it_repeats_in(tmp_path, ball):
    h5py = pytest.importorskip("h5py")
    points, fields = ball
    with h5py.File(tmp_path / "snap.hdf5", "w") as file:
        file.create_group("Header").attrs["NumPart_ThisFile"] = [len(points), 0, 0, 0, 0, 0]
        file["Header"].attrs["BoxSize"] = 1.0
        group = file.create_group("PartType0")
        group["Coordinates"] = points
        group["Density"] = np.sin(2 * np.pi * points).sum(axis=1)
    samples = uvol.read(tmp_path / "snap.hdf5")
    assert samples.box.tolist() == [1, 1, 1] and not uvol.Samples(*ball).box.any()
    named = uvol.isosurface(samples, field="Density", iso=0, periodic="header")
    given = uvol.isosurface(samples, field="Density", iso=0, periodic=(1, 1, 1))
    assert named.records.tobytes() == given.records.tobytes()
    for again in (pickle.loads(pickle.dumps(samples)), samples.take([0, 1, 2]), uvol.normals(samples, k=5)):
        assert again.box.tolist() == [1, 1, 1]
    for periodic, message in (("header", "names no box"), ("box", "or 'header'"), ((1, 1), "2 sides")):
        with pytest.raises(ValueError, match=message):
            uvol.isosurface(*ball, field="r", iso=0.3, periodic=periodic)


def test_triangles_without_an_area_are_not_measured():
    with pytest.raises(ValueError, match="three different corners"):
        uvol.measure((np.eye(3), [[0, 0, 0]]))
    with pytest.raises(TypeError, match="curved is 'no': it must be True or False"):
        uvol.measure((np.eye(3), [[0, 1, 2]]), curved="no")


def test_nothing_is_not_measured():
    for call in (lambda: uvol.measure(np.empty((0, 3))), lambda: uvol.compare(np.eye(3), np.empty((0, 3)))):
        with pytest.raises(ValueError, match="has no points"):
            call()


def test_other_threads_run_meanwhile():
    points = np.random.default_rng(3).random((100000, 3))
    samples = uvol.Samples(points, {"r": points[:, 0]})
    counted = [0]
    ended = threading.Event()

    def count():
        while not ended.is_set():
            counted[0] += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    start = time.perf_counter()
    uvol.isosurface(samples, iso=0.5)
    spent = time.perf_counter() - start
    ended.set()
    counter.join()
    assert counted[0] > 5 * spent


def test_a_notebook_shows_a_surface(sphere):
    text = sphere._repr_html_()
    assert "Surface of r at 0.3" in text and "data:image/png;base64," in text
    assert sphere._repr_png_()[:8] == b"\x89PNG\r\n\x1a\n"


def test_memory_that_is_not_there_is_a_memoryerror(run_python):
    out = run_python("""
        import resource, numpy as np, pcl_uvol as uvol
        samples = uvol.Samples(np.random.default_rng(1).random((3000000, 3)), {"r": np.arange(3e6)})
        used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (used + 80_000_000, used + 80_000_000))
        try:
            uvol.isosurface(samples, iso=5.0, threads=1)
        except MemoryError as error:
            print(error.code, error.values)
        """)
    assert re.search(r"not_enough_memory .* 3000000 .*'needed': '[\d.]+ .?B'", out)


@pytest.mark.parametrize("call, pattern", [
    ("uvol.voronoi(points, cells=1500)", r"not_enough_memory .* 1500 x \d+ x \d+ .*'needed': '4\d GB'"),
    ("uvol.empty(10**9, {'a': 'f8'})", "not_enough_memory .* 1000000000 .*'needed': '20 GB'"),
    ("uvol.Interpolator(points, {'a': points[:, 0]}).grid((1000, 1000, 1000))",
     "not_enough_memory .* 1000000000 .*'needed': '24 GB'"),
    ("uvol.Samples(points).render(size=6000)", "memory_for_picture .*'width': 6000, 'height': 6000"),
])
def test_missing_memory_is_reported_with_its_purpose(run_python, call, pattern):
    out = run_python(f"""
        import resource, numpy as np, pcl_uvol as uvol
        import pcl_uvol._charts
        points = np.random.default_rng(1).random((1000, 3))
        resource.setrlimit(resource.RLIMIT_AS, (1_200_000_000,) * 2)
        try:
            {call}
        except MemoryError as error:
            print(error.code, error.values)
        """)
    assert re.search(pattern, out)


@pytest.mark.parametrize("call, message", [
    (lambda sphere: uvol.isosurface(sphere, iso=1, smoth=True), r"isosurface\(\) has .*'smoth' \(did you mean 'smooth'\?\)"),
    (lambda sphere: uvol.isosurface(sphere), r"isosurface\(\) needs the keyword 'iso'"),
    (lambda sphere: uvol.Extractor(sphere).extract(iso=1, fild="r"), r"extract\(\) .*\(did you mean 'field'\?\)"),
    (lambda sphere: sphere.render(colour="r"), r"render\(\) .*'colour' \(did you mean 'color'\?\)"),
    (lambda sphere: sphere.orbit(3, colour="r"), r"orbit\(\) .*\(did you mean 'color'\?\)"),
    (lambda sphere: uvol.Interpolator(sphere, modl="fit"), r"Interpolator\(\) .*\(did you mean 'model'\?\)"),
    (lambda sphere: uvol.voronoi(sphere, cell=3), r"voronoi\(\) .*\(did you mean 'cells'\?\)"),
    (lambda sphere: uvol.cluster(sphere, entirely_else=3), r"cluster\(\) has no keyword 'entirely_else'\.$"),
])
def test_unknown_keywords_get_a_proposal(sphere, call, message):
    with pytest.raises(TypeError, match=message):
        call(sphere)


@pytest.mark.parametrize("options, message", [
    (dict(max_error=np.nan), "max_error is nan"),
    (dict(mu=np.float32("nan"), smooth=True), "mu is nan"),
    (dict(level_set={"tolerance": np.inf}), "tolerance is inf"),
])
def test_numbers_that_are_none_get_a_sentence(ball, options, message):
    with pytest.raises(ValueError, match=message):
        uvol.isosurface(*ball, field="r", iso=0.3, **options)


def test_edges_are_not_shorter_than_the_spacing(run_tool, sphere):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        usual, short = sphere.mesh(), sphere.mesh(edge_length=1e-3)
    assert len(short) < 1.5 * len(usual)
    for text in (uvol.Surface.mesh.__doc__, run_tool("uvol_isosurface", "-h", "mesh")):
        assert "not made shorter than the spacing of the samples" in " ".join(text.lower().split())
