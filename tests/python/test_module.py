# SPDX-License-Identifier: BSD-3-Clause
"""The module as a whole: what importing it loads, its documentation, its memory."""

import ast
import doctest
import importlib
import inspect
import json
import os
import pathlib
import pickle
import pkgutil
import re
import subprocess
import sys
import warnings

import numpy as np
import pytest

import pcl_uvol as uvol

FOLDER = pathlib.Path(uvol.__file__).parent
ROOT = pathlib.Path(__file__).resolve().parents[2]


def test_importing_is_quick_and_loads_neither_vtk_nor_opengl(run_python):
    out = run_python("""
        import time
        import numpy
        start = time.process_time()
        import pcl_uvol
        print(time.process_time() - start)
        print([line for line in open("/proc/self/maps") if "libvtk" in line or "libGL" in line or "libEGL" in line])
        """)
    spent, libraries = out.splitlines()
    assert float(spent) < 0.1
    assert libraries == "[]"


class Finder(doctest.DocTestFinder):
    """Finds examples of functions in wrappers as well."""

    def _from_module(self, module, object):
        return super()._from_module(module, inspect.unwrap(object) if inspect.isfunction(object) else object)


@pytest.mark.parametrize("name", [module.name for module in pkgutil.iter_modules(uvol.__path__)
                                  if module.name not in ("_core", "_io", "_charts", "_vtk")])
def test_examples_of_the_documentation_run(name):
    module = importlib.import_module(f"pcl_uvol.{name}")
    runner = doctest.DocTestRunner()
    for examples in Finder().find(module, module.__name__, globs={**vars(module), "np": np, "uvol": uvol}):
        runner.run(examples)
    assert runner.failures == 0


def test_the_version_is_that_of_the_tools(run_tool):
    assert run_tool("uvol_isosurface", "--version").split()[-1] == uvol.__version__


def test_everything_public_is_documented_with_an_example():
    for name in uvol.__all__:
        thing = getattr(uvol, name)
        assert ">>>" in inspect.getdoc(thing), name
        for member, value in inspect.getmembers(thing):
            if is_shown(member) and member in thing.__dict__ and (inspect.isroutine(value) or isinstance(value, property)):
                assert ">>>" in inspect.getdoc(value), f"{name}.{member}"


def is_shown(member):
    """Whether a name belongs to what users see."""
    return not member.startswith("_") or member in ("__call__", "__getitem__")


def list_functions():
    """Public functions and methods, with their names."""
    for name in uvol.__all__:
        thing = getattr(uvol, name)
        if inspect.isfunction(thing):
            yield name, thing
        for member, value in inspect.getmembers(thing, inspect.isroutine) if inspect.isclass(thing) else []:
            if is_shown(member) and not issubclass(thing, (BaseException, tuple)):
                yield f"{name}.{member}", value


def test_every_parameter_is_documented_once_with_its_default():
    for name, function in [*list_functions(), *((name, getattr(uvol, name)) for name in ("Extractor", "Interpolator", "Samples"))]:
        section = inspect.getdoc(function).partition("Parameters\n----------\n")[2].partition("\n\n")[0]
        heads = re.findall(r"(?m)^\S.*$", section)
        parameters = inspect.signature(function).parameters
        documented = [each.strip("*") for head in heads for each in head.partition(" : ")[0].split(", ")]
        assert sorted(documented) == sorted(set(parameters) - {"self"}), name
        for head in heads:
            default = parameters[head.partition(" : ")[0].split(", ")[0].strip("*")].default
            told = ", optional" if default is None else f", default {json.dumps(default) if isinstance(default, str) else default}"
            assert default is inspect.Parameter.empty or head.endswith((told, ", optional")), (name, head)


def test_docstrings_can_be_read_alone():
    for name, function in list_functions():
        assert not re.search(r"\b[Aa]s (those|that) of\b|(?m:^\{)", inspect.getdoc(function)), name
    for function in (uvol.isosurface, uvol.Extractor.extract, uvol.level_set):
        assert re.search(r"\noutside : .*\n    \w", inspect.getdoc(function))
    for name in ("error", "support"):
        assert f"- `{name}`: " in uvol.Surface.__doc__
    assert "scale : sequence of three float" in uvol.info.__doc__ and "change of the field" not in uvol.info.__doc__


def test_unknown_keywords_of_everything_get_a_proposal():
    classes = [(name, getattr(uvol, name).__init__) for name in ("Samples", "Extractor", "Interpolator")]
    checked = 0
    for name, function in [*classes, *list_functions()]:
        parameters = inspect.signature(function).parameters.values()
        values = [None for parameter in parameters
                  if parameter.kind == parameter.POSITIONAL_OR_KEYWORD and parameter.default is parameter.empty]
        for parameter in parameters:
            if parameter.name == "self" or parameter.kind == parameter.VAR_KEYWORD or function.__name__ == "__getitem__":
                continue
            wrong = parameter.name + parameter.name[-1]
            told = rf"has no keyword {wrong!r} \(did you mean '{parameter.name}s?'\?\)\.$"  # field or fields
            with pytest.raises(TypeError, match=told):
                function(*values, **{wrong: 1})
            checked += 1
    assert checked > 300


def make_one_of_each():
    """Something of every class that has attributes."""
    points = np.random.default_rng(1).random((2000, 3))
    samples = uvol.Samples(points, {"r": np.linalg.norm(points - 0.5, axis=1), "a": points[:, 0], "b": points[:, 1]})
    extractor = uvol.Extractor(samples)
    surface = extractor.extract(field="r", iso=0.3, outside="higher")
    mesh = surface.mesh()
    measures = mesh.measure()
    comparison = uvol.compare(mesh, mesh)
    interpolator = uvol.Interpolator(samples, field="r")
    return [samples, extractor, surface, mesh, measures, measures.pieces[0], comparison, comparison.forth, interpolator,
            interpolator.evaluate([[0.5, 0.5, 0.5]]), interpolator.line([0.2] * 3, [0.8] * 3, 5), surface.render(size=32),
            uvol.cluster(samples, labels=np.zeros(2000, int)), uvol.voronoi(samples, cells=4),
            uvol.project(samples, attributes=["r", "a", "b"], labels=points[:, 0] > 0.5, method="pca")]


def test_parameters_of_results_are_printable_with_all_defaults(tmp_path):
    points = np.random.default_rng(1).random((2000, 3))
    samples = uvol.Samples(points, {"r": np.linalg.norm(points - 0.5, axis=1), "a": points[:, 0], "b": points[:, 1]})
    surface = uvol.isosurface(samples, field="r", iso=0.3)
    surface.save(tmp_path / "sphere.ply")
    (tmp_path / "test.scene").write_text("size 40 30\ncloud sphere.ply\n")
    interpolator = uvol.Interpolator(samples, field="r", model="shepard")
    projection = uvol.project(samples, attributes=["r", "a", "b"], labels=points[:, 0] > 0.5, method="pca")
    halves = uvol.cluster(samples, labels=points[:, 0] > 0.5)
    results = {
        uvol.isosurface: surface,
        uvol.Surface.mesh: surface.mesh(),
        uvol.level_set: uvol.level_set(samples, field="r", iso=0.3, max_steps=2),
        uvol.normals: uvol.normals(surface),
        uvol.splats: uvol.splats(surface),
        uvol.cluster: uvol.cluster(samples, attributes=["a", "b"], single=True),
        uvol.Clusters.surface: halves.surface(0),
        uvol.project: projection,
        uvol.voronoi: uvol.voronoi(samples, cells=4),
        uvol.measure: surface.measure(),
        uvol.Interpolator: interpolator,
        uvol.Interpolator.evaluate: interpolator.evaluate([[0.5, 0.5, 0.5]]),
        uvol.Interpolator.probe: interpolator.probe([[0.5, 0.5, 0.5]]),
        uvol.Interpolator.slice: interpolator.slice("z=0.5", 8),
        uvol.Lattice.render: interpolator.slice("z=0.5", 8).render(),
        uvol.Projection.render: projection.render(size=64),
        uvol.Surface.render: surface.render(size=32),
        uvol.Surface.raytrace: surface.raytrace(size=32),
        uvol.raytrace: uvol.raytrace(tmp_path / "test.scene"),
        uvol.Samples.density: samples.density(),
        uvol.Samples.sampling: samples.sampling(),
        uvol.Samples.outer_layer: samples.outer_layer(0.0, "r"),
        uvol.Extractor: uvol.Extractor(samples),
    }
    given = {"iso", "field", "size", "max_steps", "method", "single", "model", "attributes", "cells", "mesh",
             "label"}
    for function, result in results.items():
        parameters = result.parameters
        assert parameters and len(str(parameters).splitlines()) >= len(parameters), function
        assert all(" = " in line for line in str(parameters).splitlines()), function
        assert json.loads(json.dumps(parameters)) == parameters, function
        for keyword in inspect.signature(function).parameters.values():
            if keyword.name in parameters and keyword.name not in given and keyword.default not in (None, keyword.empty):
                expected = np.asarray(keyword.default)
                found = parameters[keyword.name]
                if np.ndim(found) == np.ndim(expected) and not isinstance(found, dict):
                    assert np.all(found == expected), (function, keyword.name)
    assert pickle.loads(pickle.dumps(surface)).parameters == surface.parameters
    assert uvol.raytrace(tmp_path / "test.scene").parameters["width"] == 40
    assert samples.parameters == {} and halves.parameters == {}
    again = uvol.isosurface(samples, field="r", iso=0.3, level_set=surface.parameters["level_set"])
    assert again.records.tobytes() == surface.records.tobytes() and again.parameters == surface.parameters


def test_types_of_the_stub_have_the_names_of_the_code():
    stub = ast.parse((FOLDER / "__init__.pyi").read_text())
    classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
    functions = {node.name: node for node in stub.body if isinstance(node, ast.FunctionDef)}
    assert {name for name in {**classes, **functions} if not name.startswith("_")} == set(uvol.__all__)

    def compare(node, function):
        arguments = node.args
        assert inspect.ismethod(function) == any(name.arg == "cls" for name in arguments.args)
        listed = [argument.arg for argument in arguments.args + arguments.kwonlyargs]
        keywords = [parameter.name for parameter in inspect.signature(function).parameters.values()
                    if parameter.kind != parameter.VAR_KEYWORD]
        owners = ("self", "cls")
        assert [name for name in listed if name not in owners] == [name for name in keywords if name not in owners]

    def list_attributes(node):
        """Names that a class and those above it have in the stub."""
        above = [list_attributes(classes[base.id]) for base in node.bases if base.id in classes]
        return {item.target.id for item in node.body if isinstance(item, ast.AnnAssign)}.union(*above)

    for thing in make_one_of_each():
        held = {name for name in dir(thing) if not name.startswith("_") and not callable(getattr(thing, name))}
        assert held == list_attributes(classes[type(thing).__name__]), type(thing).__name__

    for name, node in functions.items():
        compare(node, getattr(uvol, name))
    for name, node in classes.items():
        if not name.startswith("_"):
            for method in node.body:
                if isinstance(method, ast.FunctionDef) and not method.name.startswith("__"):
                    compare(method, getattr(getattr(uvol, name), method.name))


@pytest.mark.parametrize("path", ["README.md", "python/README.md"])
def test_examples_of_the_readme_run(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / path).read_text(), re.DOTALL)
    assert blocks
    for block in blocks:
        exec(block, {})
    assert (tmp_path / "surface.png").exists()


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * 4096


@pytest.mark.long
def test_ten_thousand_calls_leave_memory_where_it_was():
    points = np.random.default_rng(1).random((300, 3))
    fields = {"r": points[:, 0]}

    def call(times):
        for _ in range(times):
            surface = uvol.isosurface(points, fields, iso=0.5, threads=1)
            assert surface.points.shape[1] == 3
            with pytest.raises(ValueError):
                uvol.isosurface(points, fields, iso=0.5, outside="up")

    call(1000)
    before = resident()
    call(10000)
    assert resident() - before < 3e6


@pytest.mark.long
def test_a_thousand_calls_of_other_stages_leave_memory_where_it_was(tmp_path):
    points = np.random.default_rng(1).random((300, 3))
    fields = {"r": np.linalg.norm(points - 0.5, axis=1), "a": points[:, 0], "n": ["x", "y", "z"] * 100}
    samples = uvol.Samples(points, fields)
    surface = uvol.isosurface(samples, field="r", iso=0.3)
    mesh, model = surface.mesh(), uvol.Interpolator(samples, field="a")
    stages = [
        lambda: uvol.Samples(points, fields)["n"],
        lambda: pickle.loads(pickle.dumps(samples)).points,
        lambda: uvol.Interpolator(samples, field="a", model="shepard")(points[:5]),
        lambda: model.grid(4)["a"],
        lambda: surface.render(size=24).pixels,
        lambda: surface.raytrace(size=12).pixels,
        lambda: uvol.normals(samples, k=5)["normal_x"],
        lambda: uvol.splats(surface).points,
        lambda: mesh.measure().area,
        lambda: uvol.cluster(samples, attributes=["r", "a"], single=True).tree,
        lambda: uvol.voronoi(samples, cells=6).site,
        lambda: uvol.level_set(samples, field="r", iso=0.3, max_steps=2, mu=0.5, snapshots=1)["phi"],
        lambda: uvol.Samples(points, fields).compute("log10(a)").where("a > 0.5"),
        lambda: uvol.info(samples),
        lambda: samples.save(tmp_path / "a.ply"),
        lambda: uvol.read(tmp_path / "a.ply"),
    ]
    samples.save(tmp_path / "a.ply")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for stage in stages:
            for _ in range(200):
                stage()
            before = resident()
            for _ in range(1000):
                stage()
            assert resident() - before < 3e6


@pytest.mark.long
def test_random_arrays_never_crash(tmp_path):
    random = np.random.default_rng(2024)
    kinds = ["f2", "f4", "f8", "i1", "u2", "i8", "?", "c8", "O", "S3", "M8[s]", ">f8"]
    extremes = [np.nan, np.inf, -np.inf, 0.0, 1e300, -1e-300, 3e38, 1.0]

    def array(shape):
        values = random.standard_normal(shape)
        if random.random() < 0.3 and values.size:
            values[random.random(values.shape) < 0.3] = random.choice(extremes)
        with np.errstate(all="ignore"):
            values = values.astype(random.choice(kinds)) if random.random() < 0.5 else values
        return values[::-1] if random.random() < 0.3 and values.ndim else values

    def shape(count):
        return random.choice(np.array([(count, 3), (count,), (count, 2), (3, count), (), (count, 3, 1)], object))

    places = [-1.0, 0.0, 1.0]
    stages = [
        lambda p, f: uvol.isosurface(p, f, field="a", iso=float(random.standard_normal()), threads=1,
                                     mesh=bool(random.random() < 0.3)),
        lambda p, f: uvol.Interpolator(p, f, field="a", threads=1)(array((5, 3))),
        lambda p, f: uvol.Interpolator(p, f, field="a", model="natural", threads=1).grid(3),
        lambda p, f: uvol.Interpolator(p, f, field="a", threads=1).validate(2, by="b", threads=1),
        lambda p, f: uvol.level_set(p, f, field="a", iso=0.1, threads=1, max_steps=5, snapshots=2),
        lambda p, f: uvol.splats(p, f, threads=1),
        lambda p, f: uvol.normals(p, f, k=3, threads=1),
        lambda p, f: uvol.cluster(p, f, attributes=["a", "x"], threads=1).surface(0, "hull", threads=1),
        lambda p, f: uvol.project(p, f, attributes=["a", "b", "x"], threads=1),
        lambda p, f: uvol.voronoi(p, f, cells=4, threads=1),
        lambda p, f: uvol.info(p, f, threads=1),
        lambda p, f: uvol.Samples(p, f).density(threads=1).outer_layer(0.0, "a", threads=1),
        lambda p, f: uvol.Samples(p, f).where("a > b").take([0]).save(tmp_path / "a.pcd"),
        lambda p, f: uvol.Samples(p, f).render(color="a", size=32, eye=random.choice(places, 3), at=array((3,)), threads=1),
        lambda p, f: uvol.Samples(p, f).sampling(threads=1),
        lambda p, f: uvol.measure(uvol.normals(p, f, k=3, threads=1), threads=1),
        lambda p, f: uvol.compare(uvol.Samples(p, f), (array((3, 3)), random.integers(-1, 4, (2, 3))), threads=1),
        lambda p, f: uvol.splats(p, f, gaussians=True, color="a", threads=1),
        lambda p, f: uvol.Interpolator(p, f, field="a", periodic=array((3,)), threads=1)(array((5, 3))),
        lambda p, f: uvol.cluster(p, f, labels=array((len(p),)), threads=1).surface(0, threads=1),
        lambda p, f: list(uvol.Samples(p, f).orbit(2, size=24, ticks=True, box=True, triad=True, threads=1)),
        lambda p, f: uvol.Samples(p, f).raytrace(color="|b|", size=16, lights=array((2, 3)), threads=1),
    ]
    calls = 0
    for _ in range(3000):
        count = int(random.choice([0, 1, 2, 3, 5, 40, 300]))
        points = array((count, 3)) if random.random() < 0.8 else array(shape(count))
        fields = {name: array((count,) if random.random() < 0.8 else shape(count)) for name in "ab"}
        with np.errstate(all="ignore"), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                stages[random.integers(len(stages))](points, fields)
                calls += 1
            except (ValueError, TypeError, KeyError, IndexError, uvol.DivergedError) as error:
                assert str(error)
    assert calls > 100


@pytest.mark.long
def test_random_keywords_get_a_sentence_or_a_result(tmp_path):
    random = np.random.default_rng(2025)
    points = random.random((300, 3))
    fields = {"r": np.linalg.norm(points - 0.5, axis=1), "a": points[:, 0], "v": points, "n": ["x", "y", "z"] * 100}
    samples = uvol.Samples(points, fields)
    surface = uvol.isosurface(samples, field="r", iso=0.3)
    model = uvol.Interpolator(samples, field="a")
    halves = points[:, 0] > 0.5
    projection = uvol.project(samples, attributes=["r", "a", "v[1]"], labels=halves)
    samples.save(tmp_path / "a.ply")
    calls = [
        (uvol.isosurface, (samples,), dict(field="r", iso=0.3)),
        (uvol.Interpolator, (samples,), dict(field="a")),
        (model.evaluate, (points[:4],), {}),
        (model.line, ([0.1] * 3, [0.9] * 3), dict(n=4)),
        (model.slice, ("z=0.5",), dict(size=6)),
        (model.grid, (), dict(n=4)),
        (model.validate, (), dict(folds=2)),
        (model.slice("z=0.5", 6).render, (), {}),
        (uvol.level_set, (samples,), dict(field="r", iso=0.3, max_steps=2, mu=0.5)),
        (uvol.normals, (samples,), dict(k=5)),
        (uvol.splats, (surface,), {}),
        (uvol.cluster, (samples,), dict(attributes=["r", "a"])),
        (uvol.cluster(samples, labels=halves).surface, (0,), {}),
        (uvol.project, (samples,), dict(attributes=["r", "a"])),
        (projection.render, (), dict(size=64)),
        (uvol.voronoi, (samples,), dict(cells=6)),
        (uvol.info, (samples,), {}),
        (uvol.measure, (surface.mesh(),), {}),
        (surface.mesh, (), {}),
        (surface.render, (), dict(size=24)),
        (surface.raytrace, (), dict(size=16)),
        (surface.save_page, (tmp_path / "a.html",), {}),
        (samples.density, (), {}),
        (samples.sampling, (), {}),
        (samples.outer_layer, (0.0, "r"), {}),
        (samples.where, ("a > 0.5",), {}),
        (samples.compute, ("log10(a)",), {}),
        (samples.take, ([0, 1],), {}),
        (samples.save, (tmp_path / "b.ply",), {}),
        (uvol.read, (tmp_path / "a.ply",), {}),
    ]
    values = [None, True, np.True_, 0, 1, 2, -1, 0.5, -0.5, np.nan, np.inf, 1e300, 2**31, 2**63, -2**70, "", "a", "v", "n",
              "auto", "|v|", "grad(a)", "a" * 5000, "a\0b", "\udc80", [], [0], [1, 2], [1, 2, 3], [np.nan] * 3, [1e30] * 3,
              ["a", "b"], [[1, 2], [3]], np.eye(3), np.zeros((0, 3)), np.array(3), np.array([1, 2, 3], object),
              np.ma.masked, {}, {"k": 3}, {1: 2}, {"mu": None}, object(), b"a", 1j, range(3), set(), np.float32(0.3),
              slice(None), int]
    of_others = ("inhomogeneous", "ambiguous", "incompatible function", "NoneType", "no len", "unsized", "unhashable",
                 "not subscriptable", "unsupported operand", "has no attribute")
    for _ in range(20000):
        function, needed, options = calls[random.integers(len(calls))]
        keywords = [name for name in inspect.signature(function).parameters
                    if name not in ("points", "fields", "path", "progress", "threads")][len(needed):]
        if not keywords:
            continue
        options = dict(options, **{str(random.choice(keywords)): values[random.integers(len(values))] for _ in range(2)})
        with np.errstate(all="ignore"), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                function(*needed, **options)
            except (ValueError, TypeError, KeyError, IndexError, MemoryError, uvol.DivergedError) as error:
                told = str(error)
                assert told and not any(phrase in told for phrase in of_others), (function, options)


def test_parameters_are_explained_where_they_are_listed():
    """Functions with the parameters of a stage have them in their signature and docstring."""
    signature = inspect.signature(uvol.level_set)
    assert signature.parameters["k"].default == 26 and signature.parameters["mu"].default is None
    assert "parameters" not in signature.parameters
    text = inspect.getdoc(uvol.level_set)
    assert "{parameters}" not in text
    assert 'flow : {"mean", "relative"}, default "relative"\n    Smoothing flow' in text
    assert "\nk : int, default 26\n    Nearest neighbours" in text
    assert "\nk : int, default 30\n    Nearest neighbours besides the point" in inspect.getdoc(uvol.normals)
    with pytest.raises(TypeError, match="did you mean 'tolerance'"):
        uvol.level_set(np.zeros((3, 3)), iso=0, tolerane=1)


def test_module_works_without_docstrings():
    environment = {**os.environ, "PYTHONOPTIMIZE": "2"}
    subprocess.run([sys.executable, "-c", "import pcl_uvol; raise SystemExit(pcl_uvol.level_set.__doc__)"], check=True,
                   env=environment)
