# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of all kinds into samples, and out again."""

import os
import pickle
import re
import subprocess

import numpy as np
import pytest
from conftest import raises

import pcl_uvol as uvol

POINTS = np.array([[0.0, 1.0, 2.0], [3.0, 4.0, 5.0], [6.0, 7.0, 8.5]])


@pytest.mark.parametrize("kind", ["?", "i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"])
def test_fields_keep_type_and_values(kind):
    values = np.array([1, 0, 1]).astype(kind)
    if kind[0] in "iu":
        info = np.iinfo(kind)
        values[:2] = info.min, info.max
    found = uvol.Samples(POINTS, {"a": values})["a"]
    assert found.dtype == values.dtype
    assert found.tolist() == values.tolist()


@pytest.mark.parametrize("kind, wider", [("f2", "f4"), ("f16", "f8"), (">f8", "f8"), (">i4", "i4"), (">f4", "f4")])
def test_other_types_become_the_next_wider_one(kind, wider):
    found = uvol.Samples(POINTS, {"a": np.array([1, 2, 3]).astype(kind)})["a"]
    assert found.dtype == np.dtype(wider)
    assert found.tolist() == [1, 2, 3]


def test_any_stride_gives_the_same_samples():
    wide = np.zeros((6, 7))
    wide[::2, 1:6:2] = POINTS
    backwards = np.asfortranarray(POINTS)[::-1]
    for points in (wide[::2, 1:6:2], backwards[::-1], POINTS.tolist(), np.asfortranarray(POINTS)):
        assert uvol.Samples(points).records.tobytes() == uvol.Samples(POINTS).records.tobytes()


def test_doubles_keep_their_digits_far_from_the_origin():
    points = POINTS * 1e-3 + [5e6, 4e5, 0.0]
    assert np.abs(uvol.Samples(points).points - points).max() < 2e-9


def test_views_look_into_the_memory_of_the_library():
    samples = uvol.Samples(POINTS.astype(np.float32), {"a": [1.0, 2.0, 3.0], "v": POINTS})
    base = samples.records.__array_interface__["data"][0]
    size = samples.records.nbytes
    for view in (samples.points, samples["a"], samples["v"]):
        assert base <= view.__array_interface__["data"][0] < base + size
        assert not view.flags.writeable
    with pytest.raises(ValueError):
        samples["a"][0] = 5


def test_records_of_empty_are_taken_as_they_are():
    records = uvol.empty(3, {"a": "f8", "v": ("f4", 3), "n": "i2", "b": bool})
    assert records.dtype["x"] == np.float32 and records["v"].shape == (3, 3) and not records["a"].any()
    for axis, name in enumerate("xyz"):
        records[name] = POINTS[:, axis]
    records["a"] = 1, 2, 3
    address = records.__array_interface__["data"][0]
    samples = uvol.Samples(records)
    assert samples.records.__array_interface__["data"][0] == address and not records.flags.writeable
    assert samples["a"].tolist() == [1, 2, 3] and np.array_equal(samples.points, POINTS.astype(np.float32))
    again = uvol.Samples(records)  # like any other array by now
    assert again.records.tobytes() == samples.records.tobytes()
    assert again.records.__array_interface__["data"][0] != address
    assert len(uvol.Samples(uvol.empty(0, {"a": "f4"}))) == 0


def test_parts_of_records_of_empty_are_copied():
    for choose in (lambda records: records[1:], lambda records: records[::2], lambda records: records[["x", "y", "z"]]):
        records = uvol.empty(4, {"a": "f4"})
        records["x"] = records["a"] = 1, 2, 3, 4
        part = choose(records)
        samples = uvol.Samples(part)
        assert records.flags.writeable and len(samples) == len(part)
        assert samples.points[:, 0].tolist() == part["x"].tolist()


@pytest.mark.parametrize("count, fields, error, expected", [
    (-1, {}, ValueError, dict(match="from 0")),
    (1.5, {}, TypeError, dict(match="whole number")),
    (3, ["a"], TypeError, dict(match="must be a dictionary")),
    (3, {"x": "f4"}, ValueError, dict(match="is a coordinate")),
    (3, {"_": "f4"}, ValueError, dict(match="padding")),
    (3, {"a": object}, ValueError, dict(match="must hold numbers")),
    (3, {"a": ("f4", (2, 2))}, ValueError, dict(match="must hold numbers")),
    (3, {"a": "q9"}, TypeError, dict(match="not understood")),
    (2**40, {"a": "f8"}, ValueError, dict(match="whole number")),
    (2**31 - 1, {"a": ("f8", 10**6)}, MemoryError, dict(code="not_enough_memory", values={"needed": "17 PB"})),
])
def test_records_that_cannot_be_get_a_sentence(count, fields, error, expected):
    with raises(error, **expected):
        uvol.empty(count, fields)


def test_views_outlive_their_samples():
    values = uvol.Samples(np.random.default_rng(1).random((10000, 3)), {"a": np.arange(10000)})["a"]
    again = [uvol.Samples(np.zeros((10000, 3))) for _ in range(5)]
    assert (values == np.arange(10000)).all() and again


def test_masked_values_are_missing():
    floats = np.ma.array([1.0, 2.0, 3.0], mask=[False, True, False], dtype=np.float32)
    integers = np.ma.array([1, 2, 3], mask=[False, True, False])
    whole = np.ma.array([1, 2, 3])
    samples = uvol.Samples(POINTS, {"f": floats, "i": integers, "w": whole})
    assert samples["f"].dtype == np.float32 and np.isnan(samples["f"]).tolist() == [False, True, False]
    assert samples["i"].dtype == np.float64 and np.isnan(samples["i"]).tolist() == [False, True, False]
    assert samples["w"].dtype == whole.dtype


def test_structured_array_brings_its_fields():
    records = np.zeros(3, [("T", "f4"), ("x", "f8"), ("y", "f8"), ("z", "f8"), ("v", "f4", (2,))])
    for axis, name in enumerate("xyz"):
        records[name] = POINTS[:, axis]
    records["T"] = 1, 2, 3
    samples = uvol.Samples(records)
    assert samples.keys() == ["T", "v"] and samples["v"].shape == (3, 2)
    assert (samples.points == POINTS).all() and samples["T"].tolist() == [1, 2, 3]


def test_dataframes():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(POINTS, columns=["x", "y", "z"]).assign(
        T=[1.0, None, 3.0], n=pandas.array([1, None, 3], dtype="Int32"), b=[True, False, True], name=["a", "b", "c"])
    samples = uvol.Samples.from_dataframe(frame)
    assert samples.keys() == ["T", "n", "b", "name"] and list(samples["name"]) == ["a", "b", "c"]
    assert samples["b"].dtype == bool and np.isnan(samples["n"]).tolist() == [False, True, False]
    back = samples.to_dataframe()
    assert back[["x", "y", "z"]].to_numpy().tolist() == POINTS.tolist() and back["T"][2] == 3
    with pytest.raises(KeyError, match="did you mean 'name'"):
        uvol.Samples.from_dataframe(frame, fields=["T", "nme"])


@pytest.mark.parametrize("values, kind, expected", [
    (("array", [1, 2, 2**60 + 1], "Int64"), "i8", [1, 2, 2**60 + 1]),
    (("Series", [1, 2, 3], "UInt8"), "u1", [1, 2, 3]),
    (("array", [1, None, 3], "Int32"), "f8", [1, np.nan, 3]),
    (("array", [True, False, True], "boolean"), "?", [True, False, True]),
    (("array", [True, None, False], "boolean"), "f8", [1, np.nan, 0]),
    (("array", [1.5, None, 2], "Float32"), "f8", [1.5, np.nan, 2]),
    (("Series", [3, 1, 3], "category"), "i8", [3, 1, 3]),
    (("Series", [3.5, None, 3], "category"), "f8", [3.5, np.nan, 3]),
    (("Series", [0, 0, 7], "Sparse[int]"), "i8", [0, 0, 7]),
    (("Index", [1, 2, 3], "int16"), None, [1, 2, 3]),
])
def test_columns_of_pandas_keep_their_type(values, kind, expected):
    pandas = pytest.importorskip("pandas")
    make, items, dtype = values
    found = uvol.Samples(POINTS, {"a": getattr(pandas, make)(items, dtype=dtype)})["a"]
    assert kind is None or found.dtype == np.dtype(kind)
    assert np.array_equal(found, expected, equal_nan=found.dtype.kind == "f")


def test_tables_that_would_lose_something_get_a_sentence():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(POINTS, columns=list("xyz")).assign(t=pandas.to_datetime(["2020"] * 3))
    for zone in (None, "UTC"):
        with pytest.raises(ValueError, match="times|objects"):
            uvol.Samples(POINTS, {"t": frame["t"].dt.tz_localize(zone)})
    with pytest.raises(ValueError, match="holds times"):
        uvol.Samples(POINTS, {"t": frame["t"].astype("category")})
    assert uvol.Samples(frame).keys() == []  # others than numbers and names are passed over
    for name in "ax":
        twice = pandas.DataFrame(np.ones((2, 5)), columns=["x", "y", "z", "a", name])
        with pytest.raises(ValueError, match=f"several columns '{name}'"):
            uvol.Samples(twice)
    with pytest.raises(TypeError, match="sequence of columns"):
        uvol.Samples.from_dataframe(frame, fields="t")


def test_samples_are_made_of_samples_and_of_no_names_of_files(tmp_path):
    samples = uvol.Samples(POINTS, {"a": [1, 2, 3]})
    assert np.shares_memory(uvol.Samples(samples)["a"], samples["a"])
    for path in ("points.ply", b"points.ply", tmp_path / "points.ply"):
        with pytest.raises(TypeError, match=r"read\(\) makes samples of files"):
            uvol.Samples(path)
    for points in (samples, samples.records):
        with pytest.raises(TypeError, match="have their fields"):
            uvol.write(tmp_path / "a.ply", points, {"b": [1, 2, 3]})


def test_what_is_masked_is_not_taken():
    samples = uvol.Samples(POINTS)
    assert len(samples.take(np.ma.array([True, True, False], mask=[True, False, True]))) == 1
    assert np.array_equal(samples.take(np.ma.array([2, 0], mask=[False, True])).points, POINTS[2:])
    for indices in (None, "a", (0, 1)):
        with pytest.raises(TypeError, match="array of indices, a mask, or a slice"):
            samples.take(indices)


def test_grids_of_xarray():
    xarray = pytest.importorskip("xarray")
    data = xarray.Dataset({name: ("n", POINTS[:, axis]) for axis, name in enumerate("xyz")} | {"T": ("n", [1, 2, 3])})
    for samples in (uvol.Samples.from_dataframe(data), uvol.Samples(data)):
        assert samples["T"].tolist() == [1, 2, 3] and np.array_equal(samples.points, POINTS)


@pytest.mark.parametrize("lattice", [lambda model: model.grid((6, 5, 4)), lambda model: model.slice("y=0.5", 6)])
def test_lattices_come_back_from_xarray(lattice):
    pytest.importorskip("xarray")
    points = np.random.default_rng(1).random((2000, 3))
    made = lattice(uvol.Interpolator(points, {"rho": points[:, 0]}, extrapolate=True))
    samples = uvol.Samples.from_dataframe(made.to_xarray())
    assert np.allclose(samples.points, made.points.reshape(-1, 3))
    assert set(samples.keys()) == set(made.keys())
    assert np.array_equal(samples["rho"], made["rho"].ravel())
    assert np.array_equal(samples["rho_gradient"], made["rho_gradient"].reshape(-1, 3))


def test_variables_of_a_grid_are_repeated_along_further_coordinates():
    xarray = pytest.importorskip("xarray")
    data = xarray.Dataset({"T": (("lon", "depth"), np.arange(6).reshape(3, 2)), "ice": ("lon", [True, False, True]),
                           "wind": ("time", [1.0, 2.0]), "u": (("time", "step", "lon"), np.zeros((2, 2, 3)))},
                          {"lon": [1.0, 2.0, 3.0], "depth": [10.0, 20.0], "lat": 5.0})
    places = ("lon", "lat", "depth")
    samples = uvol.Samples.from_dataframe(data.drop_vars("u"), places)
    assert samples.points.tolist() == [[lon, 5.0, depth] for lon in (1, 2, 3) for depth in (10, 20)]
    assert samples.keys() == ["T", "ice"] and samples["T"].tolist() == [0, 1, 2, 3, 4, 5]
    assert samples["ice"].tolist() == [True, True, False, False, True, True]
    with pytest.raises(ValueError, match="time, step besides"):
        uvol.Samples.from_dataframe(data, places)


def test_computed_fields():
    samples = uvol.Samples(POINTS, {"a": [1.0, 10.0, 100.0], "v": POINTS})
    assert samples.compute("log10(a)")["log10(a)"].tolist() == [0, 1, 2]
    assert samples.compute("a") is samples
    assert "log10(a)" not in samples
    assert samples["v[1]"].tolist() == POINTS[:, 1].tolist()
    assert np.allclose(samples["|v|"], np.linalg.norm(POINTS, axis=1))
    assert len(samples.where("a > 5")) == 2
    assert samples.take([2, 0])["a"].tolist() == [100, 1]
    assert samples.take(samples["a"] > 50).points.tolist() == [POINTS[2].tolist()]


def test_pickled_samples_are_the_same():
    samples = uvol.Samples(POINTS + [1e7, 0, 0], {"a": [1, 2, 3], "b": [True, False, True]})
    again = pickle.loads(pickle.dumps(samples))
    assert (again.points == samples.points).all()
    assert again.records.dtype == samples.records.dtype and again.records.tobytes() == samples.records.tobytes()


@pytest.mark.parametrize("ending", ["ply", "pcd", "vtp", "csv"])
def test_files_give_back_what_they_got(tmp_path, ending):
    samples = uvol.Samples(POINTS + [4e6, 0, 0], {"a": [1.5, 2.5, np.nan]})
    path = tmp_path / f"samples.{ending}"
    samples.save(path)
    again = uvol.read(path)
    assert np.array_equal(again.points, samples.points)
    assert np.array_equal(again["a"], samples["a"], equal_nan=True)


@pytest.mark.parametrize("points, fields, message", [
    (np.zeros((3, 2)), None, r"points has the shape \(3, 2\)"),
    (np.zeros(3), None, r"points has the shape \(3,\)"),
    ([[1, 2, 3], [4, 5]], None, "different lengths"),
    (np.array([["a", "b", "c"]]), None, "must hold numbers"),
    (np.zeros((2, 3), complex), None, "must hold numbers"),
    (np.zeros((2, 3), object), None, "Python objects"),
    (None, None, "points is None: it must be an array"),
    ({"x": [1], "y": [2], "z": [3]}, None, "points is {'x'.*: it must be an array"),
    (POINTS, {"a": "abc"}, "The field 'a' is 'abc': it must be an array"),
    (POINTS, {"a": [1, 2]}, "2 values for 3 points"),
    (POINTS, {"a": np.zeros((3, 2, 2))}, r"shape \(3, 2, 2\)"),
    (POINTS, {"a": np.zeros((3, 0))}, r"shape \(3, 0\)"),
    (POINTS, {"a": np.array([b"x", b"y", b"z"])}, "must hold numbers"),
    (POINTS, {"a": np.array(["2020-01-01"] * 3, "M8[D]")}, "holds times: it must hold numbers"),
    (POINTS, {"a": np.array([1, 2, 3], "m8[s]")}, "holds times"),
    (np.zeros(3, [("x", "f4", (2,)), ("y", "f4"), ("z", "f4")]), None, r"field 'x' has the shape \(3, 2\)"),
    (POINTS, {"x": [1, 2, 3]}, "is a coordinate"),
    (POINTS, {"": [1, 2, 3]}, "names are texts"),
    (POINTS, {5: [1, 2, 3]}, "names are texts"),
    (np.zeros(3, [("x", "f4"), ("y", "f4")]), None, "has no field z"),
])
def test_what_is_no_sample_gets_a_sentence(points, fields, message):
    with pytest.raises(ValueError, match=message):
        uvol.Samples(points, fields)


def test_densities_and_outer_layers_are_those_of_uvol_convert(tmp_path, run_tool):
    points = np.random.default_rng(6).random((400, 3))
    uvol.Samples(points, {"mass": np.full(400, 0.5)}).save(tmp_path / "in.ply")
    for arguments, length in (([], 0.0), (["-density-length", "0.1"], 0.1)):
        run_tool("uvol_convert", "in.ply", "tool.ply", "-density", *arguments)
        samples = uvol.read(tmp_path / "in.ply").density(length)
        assert np.array_equal(samples["sph_density"], uvol.read(tmp_path / "tool.ply")["sph_density"])
    run_tool("uvol_isosurface", "in.ply", "tool.ply", "-iso", "100", "-density", "-outside-value", "0")
    closed = uvol.read(tmp_path / "in.ply").density().outer_layer(0.0, "sph_density")
    assert len(closed) > 400 and (closed["sph_density"][400:] == 0).all()
    told = {"field": "sph_density", "iso": 100}
    for surface in (uvol.isosurface(closed, interpolation="linear", **told),
                    uvol.isosurface(uvol.read(tmp_path / "in.ply").density(), outside_value=0.0, **told)):
        surface.save(tmp_path / "module.ply")
        assert (tmp_path / "module.ply").read_bytes() == (tmp_path / "tool.ply").read_bytes()
    with pytest.warns(uvol.ResultWarning) as heard:
        uvol.isosurface(uvol.read(tmp_path / "in.ply").density(), outside_value=0.0, interpolation="fit", **told)
    assert "fits_oscillate" in [warning.message.code for warning in heard]
    with raises(ValueError, "bad_smoothing_length"):
        closed.density(-1)
    with raises(ValueError, "no_field_for_value_outside", {"field": "q"}):
        closed.outer_layer(0.0, "q")


def test_kinds_of_particles(tmp_path):
    uvol.Samples(POINTS).save(tmp_path / "a.ply")
    with raises(ValueError, "particles_of_no_snapshot", {"path": str(tmp_path / "a.ply")}):
        uvol.read(tmp_path / "a.ply", particles="dm")
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "snap.hdf5", "w") as file:
        file.create_group("Header").attrs["NumPart_ThisFile"] = [3, 2, 0, 0, 0, 0]
        for kind, count in ((0, 3), (1, 2)):
            group = file.create_group(f"PartType{kind}")
            group["Coordinates"] = POINTS[:count]
            group["Masses"] = np.arange(count, dtype=float)
    assert len(uvol.read(tmp_path / "snap.hdf5")) == 3
    assert len(uvol.read(tmp_path / "snap.hdf5", particles="dm")) == 2


def damage_each_byte(places, tmp_path, tool_folder):
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "whole.h5", "w") as file:
        file.create_group("Header").attrs["NumPart_ThisFile"] = [8, 0, 0, 0, 0, 0]
        group = file.create_group("PartType0")
        group.create_dataset("Coordinates", data=np.arange(24.0).reshape(8, 3), chunks=(3, 3))
        group["Density"] = np.arange(8, dtype=">f4")
    whole = (tmp_path / "whole.h5").read_bytes()
    for place in places:
        damaged = bytearray(whole)
        damaged[place] ^= 0xff
        (tmp_path / "damaged.h5").write_bytes(damaged)
        told = subprocess.run([tool_folder / "uvol_info", tmp_path / "damaged.h5"], capture_output=True, check=False)
        assert told.returncode in (0, 1)
        assert b"HDF5: " not in told.stderr


def test_the_library_is_silent_about_what_damaged_files_left_open(tmp_path, tool_folder):
    damage_each_byte(range(0, 120, 5), tmp_path, tool_folder)  # of the superblock and what follows it


@pytest.mark.long
def test_the_library_is_silent_about_every_damaged_byte(tmp_path, tool_folder):
    damage_each_byte(range(120), tmp_path, tool_folder)


def test_vtkhdf_is_what_h5py_reads_and_writes(tmp_path):
    h5py = pytest.importorskip("h5py")
    uvol.Samples(POINTS, {"a": [1.5, 2.5, 3.5]}).save(tmp_path / "a.vtkhdf")
    with h5py.File(tmp_path / "a.vtkhdf") as file:
        group = file["VTKHDF"]
        assert group.attrs["Type"] == b"PolyData" and list(group.attrs["Version"]) == [2, 0]
        assert np.array_equal(group["Points"], POINTS) and list(group["PointData/a"]) == [1.5, 2.5, 3.5]
        assert list(group["Vertices/Offsets"]) == [0, 1, 2, 3] and list(group["Polygons/Offsets"]) == [0]
    with h5py.File(tmp_path / "b.vtkhdf", "w") as file:
        group = file.create_group("VTKHDF")
        group.attrs["Type"], group.attrs["Version"] = "UnstructuredGrid", [1, 0]
        group["NumberOfPoints"] = [1, 2]
        group.create_dataset("Points", data=POINTS, chunks=(2, 3), compression="gzip")
        group.create_group("PointData")["a"] = np.arange(3)
    samples = uvol.read(tmp_path / "b.vtkhdf")
    assert np.array_equal(samples.points, POINTS) and list(samples["a"]) == [0, 1, 2]


def test_meshes_come_back_with_their_fields(tmp_path):
    samples = uvol.Samples(POINTS, {"a": [1.5, 2.5, 3.5]})
    samples.save(tmp_path / "points.ply")
    assert uvol.read_mesh(tmp_path / "points.ply")[1].shape == (0, 3)


def test_samples_that_no_stage_made_have_no_report():
    samples = uvol.Samples(POINTS)
    assert samples.report == {} and samples.snapshots == []
    assert uvol.normals(np.random.default_rng(1).random((50, 3))).report["counts"]


def test_a_missing_field_gets_a_proposal():
    samples = uvol.Samples(POINTS, {"density": [1, 2, 3]})
    with pytest.raises(KeyError) as caught:
        samples["densty"]
    assert "did you mean 'density'" in str(caught.value)
    with raises(uvol.FieldError, "unknown_operand", {"field": "densty", "similar": "density"}):
        samples.compute("log10(densty)")


def test_columns_that_are_none_get_a_sentence(tmp_path):
    for xyz in ("abc", 3):
        with pytest.raises(TypeError, match="sequence of three columns"):
            uvol.read(tmp_path / "a.csv", xyz=xyz)


def test_a_missing_file_is_an_oserror(tmp_path):
    with pytest.raises(OSError) as refused:
        uvol.read(tmp_path / "missing.ply")
    assert refused.value.code == "no_such_file"
    assert refused.value.values == {"path": str(tmp_path / "missing.ply")}


def test_columns_of_names_are_labels(tmp_path):
    names = ["B-2", "A-1", None, "B-2", ""]
    samples = uvol.Samples(np.arange(15.0).reshape(5, 3), {"T": np.arange(5.0), "hole": names})
    assert samples.labels == {"hole": ["A-1", "B-2"]}
    assert list(samples["hole"]) == ["B-2", "A-1", "", "B-2", ""]
    assert list(samples.records["hole"]) == [1, 0, -1, 1, -1]
    assert len(samples.where("hole = B-2 && T > 0")) == 1
    assert samples.take([1]).labels == samples.labels
    for ending in ("csv", "ply", "pcd"):
        path = tmp_path / f"holes.{ending}"
        samples.save(path)
        assert list(uvol.read(path)["hole"]) == list(samples["hole"])
    assert pickle.loads(pickle.dumps(samples)).labels == samples.labels
    for texts in (np.array(["B-2", "A-1", "", "B-2", ""]), np.array(names, dtype=object)):
        assert list(uvol.Samples(np.zeros((5, 3)), {"hole": texts})["hole"]) == list(samples["hole"])
    assert "hole (2 names)" in repr(samples)
    with pytest.raises(ValueError, match="Python objects"):
        uvol.Samples(np.zeros((2, 3)), {"hole": np.array(["a", 1], dtype=object)})


def test_names_reach_isopoints():
    grid = np.stack(np.meshgrid(*[np.arange(8.0)] * 3), axis=-1).reshape(-1, 3)
    sides = np.where(grid[:, 0] < 3.5, "west", "east")
    surface = uvol.isosurface(uvol.Samples(grid, {"r": np.linalg.norm(grid - 3.5, axis=1), "side": sides}), field="r", iso=2.5)
    assert set(surface["side"]) == {"west", "east"}
    assert all((surface["side"] == "west") == (surface.points[:, 0] < 3.5))


@pytest.mark.parametrize("use", [
    lambda samples: uvol.isosurface(samples, field="side", iso=0.5),
    lambda samples: uvol.isosurface(samples, field="side", iso=0.5, scale="auto"),
    lambda samples: uvol.level_set(samples, field="side", iso=0.5),
    lambda samples: uvol.level_set(samples, field="r", iso=2.5, start="side"),
    lambda samples: uvol.Interpolator(samples, field=["r", "side"]),
    lambda samples: uvol.cluster(samples, attributes=["r", "side"]),
    lambda samples: uvol.project(samples, attributes=["r", "side", "r"]),
    lambda samples: samples.outer_layer(0.0, "side"),
])
def test_names_are_no_values(use):
    points = np.random.default_rng(1).random((200, 3))
    samples = uvol.Samples(points, {"r": points[:, 0], "side": np.where(points[:, 0] < 0.5, "west", "east")})
    with raises(ValueError, "field_of_names") as refused:
        use(samples)
    assert refused.value.values == {"field": "side"}
    assert samples.compute("side") is samples


@pytest.mark.parametrize("use", [
    lambda samples: uvol.isosurface(samples, field="r", iso=0.5).report,
    lambda samples: uvol.isosurface(samples, field="r", iso=[0.4, 0.5], smooth=True).report,
    lambda samples: uvol.isosurface(samples, field="r", iso=0.5, mesh=True).report,
    lambda samples: uvol.level_set(samples, field="r", iso=0.5, max_steps=3).report,
    lambda samples: uvol.Interpolator(samples, field=["r", "day"])._core.report,
])
def test_samples_that_contradict_each_other_are_reported(use, recwarn):
    points = np.random.default_rng(1).random((500, 3))
    fields = {"r": np.r_[points[:, 0], points[:, 0] + 0.1], "day": np.repeat([1, 2], 500)}
    samples = uvol.Samples(np.r_[points, points], fields)
    told = [warning for warning in use(samples)["warnings"] if warning["code"] == "conflicting_samples"]
    assert [warning["values"] for warning in told] == [{"percent": 100}]
    assert [getattr(warning.message, "code", None) for warning in recwarn].count("conflicting_samples") == 1
    assert told[0]["text"] in [str(warning.message) for warning in recwarn]
    recwarn.clear()
    use(samples.where("day = 1"))
    assert "conflicting_samples" not in [getattr(warning.message, "code", None) for warning in recwarn]


def test_an_extractor_reports_contradictions_each_time(ball):
    points, fields = ball
    twice = uvol.Samples(np.r_[points, points], {"r": np.r_[fields["r"], fields["r"] + 0.01]})
    extractor = uvol.Extractor(twice)
    for iso in (0.3, 0.4):
        with pytest.warns(uvol.ResultWarning) as warned:
            extractor.extract(iso=iso)
        assert "conflicting_samples" in [warning.message.code for warning in warned]


def test_names_in_tables():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"x": [0.0, 1.0], "y": 0.0, "z": 0.0, "hole": pandas.Categorical(["b", "a"])})
    samples = uvol.Samples.from_dataframe(frame)
    assert list(samples["hole"]) == ["b", "a"]
    assert list(samples.to_dataframe()["hole"]) == ["b", "a"]


def test_masks_of_structured_arrays_are_missing_values():
    records = np.zeros(3, [("x", "f4"), ("y", "f4"), ("z", "f4"), ("T", "f4"), ("n", "i4"), ("v", "f4", (2,)), ("name", "U2")])
    records["name"] = ["a", "b", "c"]
    masked = np.ma.array(records)
    for name in ("T", "n", "name"):
        masked[name][1] = np.ma.masked
    masked["v"][2, 0] = np.ma.masked
    masked["x"][0] = np.ma.masked
    samples = uvol.Samples(masked)
    for name in ("T", "n"):
        assert np.isnan(samples[name]).tolist() == [False, True, False]
    assert np.isnan(samples["v"]).tolist() == [[False, False], [False, False], [True, False]]
    assert samples["name"].tolist() == ["a", "", "c"]
    assert np.isnan(samples.points[:, 0]).tolist() == [True, False, False]


def test_records_of_empty_with_a_mask_are_copied():
    records = uvol.empty(3, {"T": "f4"})
    masked = np.ma.array(records, mask=[(False,) * 4, (False, False, False, True), (False,) * 4])
    assert np.isnan(uvol.Samples(masked)["T"]).tolist() == [False, True, False]


@pytest.mark.parametrize("call", [
    lambda samples: uvol.Samples(POINTS, {"a\udc80b": [1, 2, 3]}),
    lambda samples: uvol.Samples(POINTS, {"hole": ["a\udc80", "b", "c"]}),
    lambda samples: uvol.empty(3, {"\udc80": "f4"}),
    lambda samples: samples.compute("\udc80"),
    lambda samples: samples.where("\udc80 > 1"),
    lambda samples: samples["|\udc80|"],
    lambda samples: uvol.isosurface(samples, field="\udc80", iso=1),
    lambda samples: uvol.isosurface(samples, iso=2, outside="\udc80"),
    lambda samples: uvol.Interpolator(samples, model="\udc80"),
    lambda samples: uvol.Interpolator(samples).validate(by="\udc80"),
    lambda samples: uvol.Interpolator(samples).slice("z=3", 4).render(colormap="\udc80"),
    lambda samples: samples.render(title="\udc80"),
    lambda samples: samples.render(color="\udc80"),
    lambda samples: uvol.read("a.h5", particles="\udc80"),
    lambda samples: uvol.read("a.csv", xyz=("x", "y", "\udc80")),
])
def test_halves_of_characters_get_a_sentence(call):
    with pytest.raises(ValueError, match="^[^\n]*halves of characters[^\n]*$"):
        call(uvol.Samples(POINTS, {"T": [1.0, 2.0, 3.0]}))


def test_fields_of_halves_of_characters_are_not_there():
    with pytest.raises(uvol.FieldError, match="There is no field"):
        uvol.Samples(POINTS)["a\udc80"]


@pytest.mark.parametrize("name", ["points\udcff.csv", "points\udcff.ply", "points\udcff.vtp", "points\udcff.npz"])
def test_names_of_files_may_be_any_bytes(tmp_path, name):
    uvol.write(tmp_path / name, POINTS, {"T": [1.0, 2.0, 3.0]})
    assert os.listdir(tmp_path) == [name]
    assert uvol.read(tmp_path / os.listdir(tmp_path)[0])["T"].tolist() == [1, 2, 3]
    with pytest.raises(OSError):
        uvol.read(str(tmp_path / name) + ".csv")


@pytest.mark.parametrize("ending", ["npz", "ply", "vtp", "vtkhdf", "pcd", "csv"])
def test_booleans_in_files(tmp_path, ending):
    np.savez(tmp_path / "made.npz", x=POINTS[:, 0], y=POINTS[:, 1], z=POINTS[:, 2], b=[True, False, True])
    samples = uvol.read(tmp_path / "made.npz")
    assert samples["b"].dtype == bool
    path = tmp_path / f"again.{ending}"
    samples.save(path)
    assert uvol.read(path)["b"].tolist() == [1, 0, 1]
    if ending == "npz":
        assert np.load(path)["b"].dtype == bool and uvol.read(path)["b"].dtype == bool


def test_docstrings_name_all_formats(run_tool):
    lines = {line.partition(":")[0]: line for line in run_tool("uvol", "--list-formats").splitlines()}
    for what, function in {"Points, read": uvol.read, "Points, written": uvol.write, "Meshes, read": uvol.read_mesh,
                           "Meshes, written": uvol.write}.items():
        for ending in re.findall(r"[.](\w+)", lines[what].partition(", by many")[0]):
            assert re.search(rf"\b{ending}\b", function.__doc__), ending


def write_positions(path, east, north, count=400):
    """A table of a temperature that falls with the depth."""
    part = [np.arange(count) * step % 997 / 997 for step in (379, 617, 211)]
    depth = 100 * part[2]
    rows = np.stack([east + 0.5 * part[0], north + 0.5 * part[1], depth, 20 - 0.1 * depth], axis=1)
    np.savetxt(path, rows, delimiter=",", header="lon,lat,depth,T", comments="")
    return rows


@pytest.mark.filterwarnings("ignore::pcl_uvol.ResultWarning")
def test_longitude_and_latitude_are_put_on_a_map(tmp_path):
    rows = write_positions(tmp_path / "a.csv", 179.75, -43)
    assert uvol.read(tmp_path / "a.csv").map is None
    samples = uvol.read(tmp_path / "a.csv", map="auto")
    assert abs(abs(samples.map.longitude) - 180) < 0.02 and abs(samples.map.latitude + 42.75) < 0.02
    x, y = samples.map.to_map(rows[:, 0], rows[:, 1])
    assert np.allclose(samples.points, np.stack([x, y, -rows[:, 2]], axis=1), atol=1e-2)
    assert samples["lon"].tolist() == rows[:, 0].tolist()
    for same in (pickle.loads(pickle.dumps(samples)), samples.take([1, 2]), samples.compute("2*T"), samples.where("T > 15")):
        assert same.map == samples.map
    given = uvol.read(tmp_path / "a.csv", map=(179.75, -43, "km"))
    assert given.map == (179.75, -43, "km")
    assert np.allclose(given.points[0, :2], 0)


@pytest.mark.filterwarnings("ignore::pcl_uvol.ResultWarning")
def test_results_have_longitude_and_latitude(tmp_path):
    write_positions(tmp_path / "a.csv", 8, -43)
    samples = uvol.read(tmp_path / "a.csv", map="auto")
    surface = uvol.isosurface(samples, field="T", iso=15, scale=(1, 1, 1000))
    east, north = surface.map.to_globe(surface.points[:, 0], surface.points[:, 1])
    assert np.allclose(surface["lon"], east) and np.allclose(surface["lat"], north)
    model = uvol.Interpolator(samples, field="T", scale=(1, 1, 1000))
    slice_ = model.slice("z=-50", 4)
    assert np.allclose(samples.map.to_map(slice_["longitude"], slice_["latitude"])[0], slice_.points[..., 0])
    probed = model.probe([[0, 0, -50]])
    assert probed["longitude"].tolist() == [samples.map.longitude]
    surface.save(tmp_path / "b.ply")
    assert uvol.read(tmp_path / "b.ply").map == samples.map


@pytest.mark.filterwarnings("ignore::pcl_uvol.ResultWarning")
def test_queries_on_another_map_are_the_same_positions(tmp_path):
    write_positions(tmp_path / "a.csv", 8, -43)
    samples = uvol.read(tmp_path / "a.csv", map="auto")
    moved = uvol.read(tmp_path / "a.csv", map=(7, -42, "km"))
    model = uvol.Interpolator(samples, field="T", scale=(1, 1, 1000), model="nearest")
    assert model(moved)[0].tolist() == samples["T"].tolist()
    assert uvol.compare(samples, moved).largest < 0.1


@pytest.mark.parametrize("wrong", ["here", (1,), (1, 2, "ft"), (1, 2, "km", 3), 5])
def test_maps_that_are_none_are_refused(tmp_path, wrong):
    with pytest.raises(ValueError, match="map is"):
        uvol.read(tmp_path / "a.csv", map=wrong)
    with pytest.raises(ValueError, match="degrees"):
        uvol.Map(0, 95).to_map(0, 0)
