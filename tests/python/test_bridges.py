# SPDX-License-Identifier: BSD-3-Clause
"""Objects of other packages. Those that the distribution lacks are stubs of what is called."""

import sys
import types

import numpy as np
import pytest

import pcl_uvol as uvol


def test_vtk(sphere):
    pytest.importorskip("vtkmodules.vtkCommonDataModel")
    from vtkmodules.util.numpy_support import vtk_to_numpy
    data = sphere.to_vtk()
    assert data.GetNumberOfPoints() == data.GetNumberOfVerts() == len(sphere)
    assert np.array_equal(vtk_to_numpy(data.GetPoints().GetData()), sphere.points)
    assert np.array_equal(vtk_to_numpy(data.GetPointData().GetNormals()), sphere.normals)
    assert np.array_equal(vtk_to_numpy(data.GetPointData().GetArray("vel")), sphere["vel"])
    mesh = sphere.mesh()
    data = mesh.to_vtk()
    assert data.GetNumberOfPolys() == len(mesh.triangles)
    corners = [data.GetCell(7).GetPointId(corner) for corner in range(3)]
    assert corners == mesh.triangles[7].tolist()
    again = uvol.from_vtk(data)
    assert np.array_equal(again.points, mesh.points) and np.array_equal(again["error"], mesh["error"], equal_nan=True)


def test_names_come_back_from_vtk():
    pytest.importorskip("vtkmodules.vtkCommonDataModel")
    samples = uvol.Samples(np.eye(3), {"hole": ["b", "", "a"], "n": [1, 2, 3]})
    again = uvol.from_vtk(samples.to_vtk())
    assert again["hole"].tolist() == ["b", "", "a"] and again["n"].tolist() == [1, 2, 3]


def test_grids_of_vtk():
    pytest.importorskip("vtkmodules.vtkCommonDataModel")
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
    image = vtkImageData()
    image.SetDimensions(2, 3, 4)
    image.SetOrigin(1, 2, 3)
    image.SetSpacing(0.5, 1, 2)
    array = numpy_to_vtk(np.arange(24, dtype=np.int16))
    array.SetName("n")
    image.GetPointData().AddArray(array)
    samples = uvol.from_vtk(image)
    assert len(samples) == 24 and samples["n"].dtype == np.int16
    assert samples.points[1].tolist() == [1.5, 2, 3] and samples.points[23].tolist() == [1.5, 4, 9]
    assert len(uvol.from_vtk(vtkPolyData())) == 0
    with pytest.raises(TypeError, match="not a vtkDataSet"):
        uvol.from_vtk([1, 2])


def test_pandas(sphere):
    pytest.importorskip("pandas")
    frame = sphere.to_dataframe()
    assert list(frame.columns[:3]) == ["x", "y", "z"] and np.array_equal(frame["vel_2"], sphere["vel"][:, 2])


class Recorder:
    """Stands for a class of a package: keeps what it was made of."""

    def __init__(self, *arguments, **options):
        self.arguments = arguments
        self.options = options


def test_trimesh(sphere, monkeypatch):
    monkeypatch.setitem(sys.modules, "trimesh", types.SimpleNamespace(Trimesh=Recorder, PointCloud=Recorder))
    mesh = sphere.mesh()
    made = mesh.to_trimesh().options
    assert np.array_equal(made["vertices"], mesh.points) and np.array_equal(made["faces"], mesh.triangles)
    assert np.array_equal(made["vertex_normals"], mesh.normals) and made["process"] is False
    assert np.array_equal(made["vertex_attributes"]["vel"], mesh["vel"])
    assert np.array_equal(sphere.to_trimesh().arguments[0], sphere.points)


def test_open3d(sphere, monkeypatch):
    utility = types.SimpleNamespace(Vector3dVector=np.array, Vector3iVector=np.array)
    geometry = types.SimpleNamespace(TriangleMesh=Recorder, PointCloud=Recorder)
    monkeypatch.setitem(sys.modules, "open3d", types.SimpleNamespace(utility=utility, geometry=geometry))
    mesh = sphere.mesh()
    made = mesh.to_open3d()
    assert np.array_equal(made.arguments[0], mesh.points) and made.arguments[1].dtype == np.int32
    assert np.array_equal(made.vertex_normals, mesh.normals)
    cloud = sphere.to_open3d()
    assert np.array_equal(cloud.arguments[0], sphere.points) and cloud.normals.dtype == np.float64


def test_pyvista(sphere, monkeypatch):
    pytest.importorskip("vtkmodules.vtkCommonDataModel")
    monkeypatch.setitem(sys.modules, "pyvista", types.SimpleNamespace(wrap=Recorder))
    assert sphere.to_pyvista().arguments[0].GetNumberOfPoints() == len(sphere)
