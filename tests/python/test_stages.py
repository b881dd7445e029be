# SPDX-License-Identifier: BSD-3-Clause
"""The stages beside isosurfaces: what the tools write."""

import concurrent.futures
import json
import warnings

import numpy as np
import pytest
from conftest import raises, warns

import pcl_uvol as uvol


def compare(tmp_path, run_tool, tool, samples, arguments, make):
    """What a tool makes of samples, and what the module does, as files."""
    samples.save(tmp_path / "in.ply")
    run_tool(tool, "in.ply", "tool.ply", *arguments)
    make(uvol.read(tmp_path / "in.ply")).save(tmp_path / "module.ply")
    assert (tmp_path / "module.ply").read_bytes() == (tmp_path / "tool.ply").read_bytes()


@pytest.mark.parametrize("arguments, options", [
    (["-mu", "0.5"], dict(mu=0.5)),
    (["-sphere", "1000.5,0.5,0.5,0.2", "-outside", "higher", "-steps", "20"],
     dict(start={"kind": "sphere", "first": [1000.5, 0.5, 0.5], "radius": 0.2}, outside="higher", max_steps=20)),
    (["-start", "r-0.3", "-scale", "auto", "-flow", "mean"],
     dict(start="r-0.3", scale="auto", flow="mean")),
    (["-mu", "0.5", "-scale", "1,1,2", "-rotate", "20,30,0"], dict(mu=0.5, scale=(1, 1, 2), rotate=(20, 30, 0))),
])
def test_level_sets(tmp_path, run_tool, ball, arguments, options):
    points, fields = ball
    samples = uvol.Samples(points + [1000, 0, 0], fields)
    compare(tmp_path, run_tool, "uvol_levelset", samples, ["-field", "r", "-iso", "0.3", *arguments],
            lambda samples: uvol.level_set(samples, field="r", iso=0.3, **options))


def test_level_sets_report_weak_support_as_the_tool_does(tmp_path, run_tool):
    run_tool("uvol_generate", "in.pcd", "-field", "torus", "-n", 5000, "-samples", "holes")
    told = json.loads(run_tool("uvol_levelset", "in.pcd", "out.ply", "-field", "torus", "-iso", 0, "-steps", 1, "-json"))
    weak = [warning for warning in told["warnings"] if warning["code"] == "unconstrained_level_set"]
    assert len(weak) == 1
    with warns("unconstrained_level_set") as warned:
        found = uvol.level_set(uvol.read(tmp_path / "in.pcd"), field="torus", iso=0, max_steps=1)
    assert "unconstrained_level_set" in [warning.message.code for warning in warned]
    same = [warning for warning in found.report["warnings"] if warning["code"] == "unconstrained_level_set"]
    assert [warning["values"] for warning in same] == [weak[0]["values"]]
    # The tool names options, the module arguments.
    assert " -fill-gaps " in weak[0]["text"] and " fill_gaps " in same[0]["text"]


@pytest.mark.parametrize("arguments, options", [
    (["-periodic", "1,1,1"], dict(periodic=(1, 1, 1))),
    (["-periodic", "1,0,1", "-scale", "auto"], dict(periodic=(1, 0, 1), scale="auto")),
])
def test_level_sets_in_boxes_that_repeat(tmp_path, run_tool, arguments, options):
    points = np.random.default_rng(3).random((4000, 3))
    samples = uvol.Samples(points, {"f": np.sin(2 * np.pi * points).sum(axis=1)})
    compare(tmp_path, run_tool, "uvol_levelset", samples,
            ["-field", "f+0", "-iso", "0", "-mu", "0.5", "-steps", "10", "-snapshots", "5", *arguments],
            lambda samples: uvol.level_set(samples, field="f+0", iso=0, mu=0.5, max_steps=10, snapshots=5, **options))
    smooth = uvol.level_set(uvol.read(tmp_path / "in.ply"), field="f+0", iso=0, mu=0.5, max_steps=10, snapshots=5, **options)
    smooth.snapshots[0][1].save(tmp_path / "module.ply")
    assert (tmp_path / "module.ply").read_bytes() == (tmp_path / "tool_00005.ply").read_bytes()
    with raises(ValueError, "turned_periodic_box"):
        uvol.level_set(samples, field="f", iso=0, rotate=(30, 20, 10), **options)


@pytest.mark.parametrize("scale", ["1,1,1", "auto"])
def test_level_sets_of_derivatives_see_across_the_faces(tmp_path, run_tool, scale):
    points = np.random.default_rng(3).random((4000, 3))
    samples = uvol.Samples(points, {"f": np.sin(2 * np.pi * points).sum(axis=1)})
    options = dict(field="|grad(f)|", iso=8, start="x-f", mu=0.5, max_steps=2, periodic=(1, 1, 1),
                   scale="auto" if scale == "auto" else (1, 1, 1))
    compare(tmp_path, run_tool, "uvol_levelset", samples,
            ["-field", "|grad(f)|", "-iso", "8", "-start", "x-f", "-mu", "0.5", "-steps", "2", "-periodic", "1,1,1",
             "-scale", scale],
            lambda samples: uvol.level_set(samples, **options))
    smooth = uvol.level_set(samples, **options)
    truth = np.linalg.norm(2 * np.pi * np.cos(2 * np.pi * points), axis=1)
    assert np.abs(smooth["|grad(f)|"] - truth).max() < 0.15


def test_a_level_set_reports_its_steps(ball):
    smooth = uvol.level_set(*ball, field="r", iso=0.3, mu=0.5)
    assert smooth.report["mu"] == 0.5 and len(smooth.report["steps"]) > 0
    assert smooth["phi"].shape == (4000,)
    inside = smooth["r"] < 0.3
    assert np.mean((smooth["phi"] < 0) == inside) > 0.97


def test_the_choice_of_a_weight_reports_its_progress(ball):
    points, fields = ball
    random = np.random.default_rng(8)
    points = random.random((40000, 3))  # enough to take some time
    noisy = np.linalg.norm(points - 0.5, axis=1) + 0.03 * random.standard_normal(len(points))
    told = []
    uvol.level_set(points, {"r": noisy}, iso=0.3, progress=lambda step, done: told.append((step, done)))
    choice = [done for step, done in told if step == "mu"]
    assert len(choice) > 0 and choice == sorted(choice) and choice[-1] <= 1


def test_snapshots_of_a_level_set_are_those_of_the_tool(tmp_path, run_tool, ball):
    uvol.Samples(*ball).save(tmp_path / "in.ply")
    run_tool("uvol_levelset", "in.ply", "out.ply", "-field", "r", "-iso", "0.3", "-mu", "0.5", "-snapshots", "5")
    smooth = uvol.level_set(uvol.read(tmp_path / "in.ply"), field="r", iso=0.3, mu=0.5, snapshots=5)
    files = sorted(tmp_path.glob("out_*.ply"))
    assert len(files) == len(smooth.snapshots) > 0
    for path, (steps, surface) in zip(files, smooth.snapshots):
        assert path.stem == f"out_{steps:05}"
        surface.save(tmp_path / "module.ply")
        assert (tmp_path / "module.ply").read_bytes() == path.read_bytes()


def codes(samples):
    return [warning["code"] for warning in samples.report["warnings"]]


def test_normals(tmp_path, run_tool, sphere):
    compare(tmp_path, run_tool, "uvol_normals", sphere, ["-k", "12"], lambda samples: uvol.normals(samples, k=12))
    bare = uvol.Samples(sphere.points)
    assert "oriented_to_zero" not in codes(uvol.normals(bare, view_point=[0, 0, 0]))
    with pytest.warns(uvol.ResultWarning):
        assert "oriented_to_zero" in codes(uvol.normals(bare))
    found = uvol.normals(bare, view_point=[0.5, 0.5, 0.5])
    found = np.stack([found[f"normal_{axis}"] for axis in "xyz"], axis=1)
    assert (np.sum(found * (sphere.points - 0.5), axis=1) < 0).all()


def test_splats(tmp_path, run_tool, sphere):
    compare(tmp_path, run_tool, "uvol_splats", sphere, ["-delta", "0.001", "-lambda", "0.5"],
            lambda samples: uvol.splats(samples, delta=0.001, overlap=0.5))
    assert len(uvol.splats(sphere, delta=0.01, delta_is_length=True)) < len(sphere)


@pytest.mark.parametrize("arguments, options", [([], {}), (["-color", "r"], dict(color="r"))])
def test_splats_as_gaussians(tmp_path, run_tool, ball, arguments, options):
    surface = uvol.isosurface(*ball, field="r", iso=[0.2, 0.3], outside="higher")
    compare(tmp_path, run_tool, "uvol_splats", surface, ["-gaussians", *arguments],
            lambda samples: uvol.splats(samples, gaussians=True, **options))
    far = uvol.Samples(surface.points + [5e5, 0, 0], {name: surface[name] for name in surface.keys()})
    with warns("gaussians_without_origin") as warned:
        uvol.splats(far, gaussians=True)
    lost, = (warning.message for warning in warned if warning.message.code == "gaussians_without_origin")
    assert lost.values["origin"].startswith("5")
    with raises(KeyError, "unknown_field", {"field": "q"}):
        uvol.splats(surface, gaussians=True, color="q")


@pytest.fixture
def groups():
    """Two groups in three attributes."""
    random = np.random.default_rng(5)
    centers = np.repeat([[0, 0, 0], [4, 4, 0]], 150, axis=0)
    values = centers + random.standard_normal((300, 3))
    return uvol.Samples(random.random((300, 3)), {name: values[:, k] for k, name in enumerate("abc")})


def test_clusters(tmp_path, run_tool, groups):
    clusters = uvol.cluster(groups, attributes=["a", "b"])
    assert len(clusters) == 2 and "2 of 300" in repr(clusters)
    first, second = clusters.labels[:150], clusters.labels[150:]
    assert abs(np.median(first) - np.median(second)) == 1
    assert clusters.tree["parent"][0] == -1 and (clusters.probabilities[clusters.labels < 0] == 0).all()
    groups.save(tmp_path / "in.csv")
    run_tool("uvol_cluster", "in.csv", "tool.csv", "-attributes", "a,b")
    tool = uvol.read(tmp_path / "tool.csv")
    clusters = uvol.cluster(uvol.read(tmp_path / "in.csv"), attributes=["a", "b"])
    assert np.array_equal(tool["label"], clusters.labels)
    assert np.array_equal(tool["probability"].astype(np.float32), clusters.probabilities)
    clusters.samples.save(tmp_path / "module.csv")
    assert (tmp_path / "module.csv").read_bytes() == (tmp_path / "tool.csv").read_bytes()


def test_clusters_that_are_known_have_surfaces(tmp_path, run_tool, groups):
    halves = uvol.Samples(groups.points, {"a": groups["a"], "half": (groups.points[:, 0] > 0.5).astype(np.int32)})
    halves.save(tmp_path / "in.ply")
    for kind in ("membership", "hull"):
        run_tool("uvol_cluster", "in.ply", "tool.ply", "-label", "half", "-cluster", "1", "-surface", kind)
        found = uvol.cluster(uvol.read(tmp_path / "in.ply"), labels=halves["half"]).surface(1, kind)
        surface, triangles = found if kind == "hull" else (found, None)
        uvol.write(tmp_path / "module.ply", surface, triangles=triangles)
        assert (tmp_path / "module.ply").read_bytes() == (tmp_path / "tool.ply").read_bytes()
    assert len(uvol.cluster(halves, labels=halves["half"])) == 2


def test_samples_report_their_sampling(tmp_path, run_tool, ball):
    uvol.Samples(*ball).save(tmp_path / "in.ply")
    run_tool("uvol_info", "in.ply", "-out", "tool.ply", "-scale", "1,2,1")
    uvol.read(tmp_path / "in.ply").sampling(scale=(1, 2, 1)).save(tmp_path / "module.ply")
    assert (tmp_path / "module.ply").read_bytes() == (tmp_path / "tool.ply").read_bytes()


@pytest.mark.parametrize("kind, options, arguments", [
    ("membership", {}, []),
    ("membership", dict(smoothing_length="h", scale="auto"), ["-smoothing-length", "h", "-scale", "auto"]),
    ("membership", dict(scale=(1, 1, 2), rotate=(0, 30, 10)), ["-scale", "1,1,2", "-rotate", "0,30,10"]),
    ("distance", dict(cells=30, distance=0.2), ["-grid", "30", "-distance", "0.2"]),
    ("hull", dict(scale=(1, 1, 2), rotate=(0, 30, 10)), ["-scale", "1,1,2", "-rotate", "0,30,10"]),
    ("hull", {}, []),
    ("hull-distance", dict(cells=20), ["-grid", "20"]),
])
def test_surfaces_of_clusters(tmp_path, run_tool, groups, kind, options, arguments):
    groups = uvol.Samples(groups.points, {**{name: groups[name] for name in "abc"}, "h": np.full(300, 0.1)})
    groups.save(tmp_path / "in.ply")
    run_tool("uvol_cluster", "in.ply", "tool.ply", "-attributes", "a,b", "-cluster", "1", "-surface", kind, *arguments)
    clusters = uvol.cluster(uvol.read(tmp_path / "in.ply"), attributes=["a", "b"])
    found = clusters.surface(1, kind, **options)
    surface, triangles = found if kind != "membership" else (found, np.empty((0, 3)))
    points, tool_triangles = uvol.read_mesh(tmp_path / "tool.ply")
    assert np.array_equal(points.points, surface.points) and np.array_equal(tool_triangles, triangles)
    uvol.write(tmp_path / "module.ply", surface, triangles=triangles if kind != "membership" else None)
    assert (tmp_path / "module.ply").read_bytes() == (tmp_path / "tool.ply").read_bytes()
    assert len(surface) > 10 and len(clusters.take(1)) == (clusters.labels == 1).sum()
    in_library = dict(code="no_such_cluster", values={"cluster": 7})
    with raises(ValueError, **(in_library if kind == "membership" else dict(match="cluster 7 "))):
        clusters.surface(7, kind)


def test_projections(tmp_path, run_tool, groups):
    groups.save(tmp_path / "in.csv")
    run_tool("uvol_project", "in.csv", "tool.csv", "-attributes", "a,b,c,a*b")
    tool = uvol.read(tmp_path / "tool.csv")
    found = uvol.project(uvol.read(tmp_path / "in.csv"), attributes=["a", "b", "c", "a*b"])
    assert np.array_equal(found.places, tool.records[["x", "y", "z"]].tolist())
    assert np.array_equal(found.labels, tool["label"])
    rows = np.array(found.map["rows"])
    assert np.allclose(rows @ rows.T, np.eye(3), atol=1e-6)
    given = uvol.project(groups, attributes=["a", "b", "c"], labels=[0] * 150 + [1] * 150, method="pca")
    assert np.array_equal(given.labels, [0] * 150 + [1] * 150)


def test_voronoi_finds_the_nearest():
    points = np.random.default_rng(9).random((50, 3)) + [100, 0, 0]
    diagram = uvol.voronoi(points, cells=24)
    assert max(diagram.site.shape) == 24
    cells = np.stack(np.meshgrid(*(np.arange(side) for side in diagram.site.shape), indexing="ij"), axis=-1)[..., ::-1]
    centers = diagram.origin + (cells + 0.5) * diagram.spacing
    distances = np.linalg.norm(centers[..., None, :] - points, axis=-1)
    diagonal = np.linalg.norm(diagram.spacing)
    assert (np.take_along_axis(distances, diagram.site[..., None].astype(int), -1)[..., 0]
            <= distances.min(-1) + diagonal).all()
    assert (np.abs(diagram.distance - distances.min(-1)) <= diagonal).all()
    assert uvol.voronoi(points, cells=(3, 4, 5)).site.shape == (5, 4, 3)


@pytest.mark.parametrize("arguments, options", [
    (["-grid", "20"], dict(cells=20)),
    (["-grid", "9", "-margin", "2"], dict(cells=9, margin=2)),
    (["-grid", "5x6x7"], dict(cells=(5, 6, 7))),
])
def test_voronoi_grids_are_those_of_the_tool(tmp_path, run_tool, arguments, options):
    pytest.importorskip("vtkmodules.vtkIOXML")
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader
    uvol.Samples(np.random.default_rng(9).random((50, 3)) + [100, 0, 0]).save(tmp_path / "in.ply")
    run_tool("uvol_voronoi", "in.ply", "tool.vti", *arguments)
    reader = vtkXMLImageDataReader()
    reader.SetFileName(str(tmp_path / "tool.vti"))
    reader.Update()
    data = reader.GetOutput()
    found = uvol.voronoi(uvol.read(tmp_path / "in.ply"), **options)
    for name in ("site", "distance"):
        expected = vtk_to_numpy((data.GetCellData().GetArray(name) or data.GetPointData().GetArray(name)))
        assert np.array_equal(getattr(found, name).ravel(), expected)
    assert np.allclose(found.spacing, data.GetSpacing())


def test_points_are_chosen_as_the_tool_does(tmp_path, run_tool, ball):
    uvol.Samples(*ball).save(tmp_path / "in.ply")
    expression = "r < 0.3 && vel_0 > 0"
    run_tool("uvol_convert", "in.ply", "tool.ply", "-where", expression)
    uvol.read(tmp_path / "in.ply").where(expression).save(tmp_path / "module.ply")
    assert (tmp_path / "module.ply").read_bytes() == (tmp_path / "tool.ply").read_bytes()


def test_info_is_that_of_the_tool(tmp_path, run_tool, ball):
    uvol.Samples(*ball).save(tmp_path / "in.ply")
    told = json.loads(run_tool("uvol_info", "in.ply", "-json", "-scale", "1,2,1"))
    facts = uvol.info(uvol.read(tmp_path / "in.ply"), scale=(1, 2, 1))
    assert told["lower_corner"] == facts["lower"] and told["upper_corner"] == facts["upper"]
    assert told["spacing"] == facts["spacing"] and told["counts"]["duplicates"] == facts["duplicates"]
    for name, expected in told["ranges"].items():
        assert {key: facts["fields"][name][key] for key in expected} == expected


def test_eight_threads_run_all_stages_at_once(ball):
    samples = uvol.Samples(*ball)
    surface = uvol.isosurface(samples, field="r", iso=0.3, outside="higher")
    model = uvol.Interpolator(samples, field="r", threads=1)
    work = [
        lambda: uvol.isosurface(samples, field="|vel|*2", iso=0.5, threads=1).records,
        lambda: uvol.level_set(samples, field="r", iso=0.3, mu=0.5, max_steps=3, threads=1)["phi"],
        lambda: model.grid(6)["r"],
        lambda: surface.render(size=64, color="r", ticks=True, threads=1).pixels,
        lambda: surface.mesh(threads=1).triangles,
        lambda: uvol.normals(surface, threads=1)["normal_x"],
        lambda: uvol.splats(surface, threads=1).records,
        lambda: samples.compute("|grad(r)|", threads=1).where("r < 0.3", threads=1).records,
    ]

    def run(number):
        return [work[(number + step) % 8]().tobytes() for step in range(8)]

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        expected = [stage().tobytes() for stage in work]
        with concurrent.futures.ThreadPoolExecutor(8) as pool:
            found = list(pool.map(run, range(8)))
    for number, results in enumerate(found):
        assert results == [expected[(number + step) % 8] for step in range(8)]


def test_info(ball):
    points, fields = ball
    facts = uvol.info(points, {**fields, "gap": np.where(fields["r"] > 0.4, np.nan, fields["r"])})
    assert facts["points"] == 4000 and np.allclose(facts["lower"], points.min(0)) and facts["duplicates"] == 0
    assert facts["fields"]["r"]["max"] == fields["r"].max() and sum(facts["fields"]["r"]["histogram"]) == 4000
    assert facts["fields"]["vel[2]"]["missing"] == 0
    assert facts["fields"]["gap"]["missing"] == np.sum(fields["r"] > 0.4)
    assert 0.01 < facts["spacing"]["median"] < 0.1
    named = uvol.info(points[:3], {"hole": ["a", "b", "a"], "n": [1, 2, 3]})
    assert named["names"] == {"hole": 2} and list(named["fields"]) == ["n"]
    assert "min" not in uvol.info(points[:2], {"n": [np.nan, np.nan]})["fields"]["n"]


@pytest.mark.parametrize("call, error, expected", [
    (lambda b: uvol.level_set(*b, field="r", iso=[1, 2]), ValueError, dict(match="one number")),
    (lambda b: uvol.level_set(*b, field="r", iso=0.3, mu=2), ValueError, dict(code="mu_out_of_range", values={"mu": 2})),
    (lambda b: uvol.level_set(*b, field="r", iso=0.3, speed=2), TypeError, dict(match="no keyword 'speed'")),
    (lambda b: uvol.level_set(*b, field="r", iso=0.3, flow="fast"), ValueError,
     dict(code="wrong_parameter", values={"name": "flow", "value": '"fast"'})),
    (lambda b: uvol.level_set(*b, field="r", iso=9.0), ValueError, dict(code="isovalue_beyond_values", values={"isovalue": "9"})),
    (lambda b: uvol.normals(*b, k=0), ValueError, dict(code="few_neighbors_for_normals", values={"neighbors": 0})),
    (lambda b: uvol.splats(*b, delta=-1), ValueError, dict(code="splat_delta_not_positive", values={"delta": -1})),
    (lambda b: uvol.level_set(*b, field="r", iso=0.3, max_step=2), TypeError, dict(match="did you mean 'max_steps'")),
    (lambda b: uvol.cluster(*b, attributes="r"), TypeError, dict(match="sequence")),
    (lambda b: uvol.cluster(*b, attributes=3), TypeError, dict(match="sequence")),
    (lambda b: uvol.cluster(*b, attributes=[3]), TypeError, dict(match="must be a text")),
    (lambda b: uvol.cluster(*b, labels=b[1]["id"]).take(5000), ValueError, dict(match="numbered from 0 to 3999")),
    (lambda b: uvol.cluster(*b, labels=b[1]["id"]).surface("a", "hull"), ValueError, dict(match="cluster 'a' does not exist")),
    (lambda b: uvol.cluster(*b, attributes=["q"]), KeyError, dict(code="unknown_lone_field", values={"field": "q"})),
    (lambda b: uvol.cluster(*b, attributes=[]), ValueError, dict(code="no_attributes")),
    (lambda b: uvol.cluster(*b, attributes=["r"], labels=b[1]["id"]), ValueError, dict(match="give one of them")),
    (lambda b: uvol.cluster(*b, labels=[1, 2]), ValueError, dict(match="2 numbers for 4000 points")),
    (lambda b: uvol.cluster(*b, labels=b[1]["r"]), ValueError, dict(match="whole numbers")),
    (lambda b: uvol.cluster(*b, labels=np.full(4000, 2**40)), ValueError, dict(match="below 2\\^31")),
    (lambda b: uvol.project(*b, attributes=["r", "id"], labels=[0.5]), ValueError, dict(match="whole numbers")),
    (lambda b: uvol.project(*b, attributes=["r", "id"], labels=[1, 2]), ValueError, dict(match="labels")),
    (lambda b: uvol.voronoi(*b, cells=0), ValueError, dict(code="voronoi_cells_out_of_range")),
    (lambda b: uvol.voronoi(*b, cells=(1, 2)), ValueError, dict(match="must be one, or three")),
    (lambda b: uvol.voronoi(*b, cells=10**6), ValueError, dict(code="voronoi_cells_out_of_range")),
])
def test_mistakes_get_a_sentence(ball, call, error, expected):
    with raises(error, **expected):
        call(ball)
