# SPDX-License-Identifier: BSD-3-Clause
"""To and from the types of other packages, which are imported when they are asked for."""

import numpy as np

from . import _parameters


class Bridges:
    """Mixed into points; a mesh has `triangles` as well."""

    def to_vtk(self):
        """A vtkPolyData of python3-vtk with all fields: a copy. Points are vertices, a
        mesh has polygons.

        Returns
        -------
        vtkmodules.vtkCommonDataModel.vtkPolyData
            Coordinates in the type of `points`, booleans as bytes, names as texts.

        Examples
        --------
        >>> data = uvol.Samples(np.eye(3), {"rho": [1.0, 2.0, 3.0]}).to_vtk()
        >>> data.GetNumberOfPoints(), data.GetPointData().GetArrayName(0)
        (3, 'rho')
        """
        from vtkmodules.util.numpy_support import numpy_to_vtk
        from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
        from vtkmodules.vtkCommonDataModel import vtkPolyData

        def to_array(values, name):
            if values.dtype.kind == "O":
                array = vtkStringArray()
                for text in values:
                    array.InsertNextValue(text)
                array.SetName(name)
                return array
            if values.dtype.kind == "b":
                values = values.astype(np.uint8)
            array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
            array.SetName(name)
            return array

        data = vtkPolyData()
        points = vtkPoints()
        points.SetData(to_array(self.points, "points"))
        data.SetPoints(points)
        cells = _to_cells(getattr(self, "triangles", np.arange(len(self))[:, None]))
        if hasattr(self, "triangles"):
            data.SetPolys(cells)
        else:
            data.SetVerts(cells)
        for name in self.keys():
            if not name.startswith("normal_"):
                data.GetPointData().AddArray(to_array(self[name], name))
        if _has_normals(self):
            data.GetPointData().SetNormals(to_array(_normals_of(self), "Normals"))
        return data

    def to_pyvista(self):
        """A pyvista.PolyData with all fields: that of `to_vtk`.

        Returns
        -------
        pyvista.PolyData

        Examples
        --------
        >>> uvol.Samples(np.eye(3), {"rho": [1.0, 2.0, 3.0]}).to_pyvista().plot()  # doctest: +SKIP
        """
        import pyvista
        return pyvista.wrap(self.to_vtk())

    def to_open3d(self):
        """A geometry of Open3D in double, with normals where there are some; it has no
        other fields.

        Returns
        -------
        open3d.geometry.TriangleMesh or open3d.geometry.PointCloud
            Of a mesh, or of points.

        Examples
        --------
        >>> import open3d  # doctest: +SKIP
        >>> open3d.visualization.draw([surface.mesh().to_open3d()])  # doctest: +SKIP
        """
        import open3d
        points = open3d.utility.Vector3dVector(np.asarray(self.points, np.float64))
        if hasattr(self, "triangles"):
            triangles = open3d.utility.Vector3iVector(self.triangles.astype(np.int32))
            geometry = open3d.geometry.TriangleMesh(points, triangles)
            if _has_normals(self):
                geometry.vertex_normals = open3d.utility.Vector3dVector(_normals_of(self).astype(np.float64))
            return geometry
        geometry = open3d.geometry.PointCloud(points)
        if _has_normals(self):
            geometry.normals = open3d.utility.Vector3dVector(_normals_of(self).astype(np.float64))
        return geometry

    def to_trimesh(self):
        """A trimesh.Trimesh of a mesh, with all fields as attributes of the vertices, else a
        trimesh.PointCloud.

        Returns
        -------
        trimesh.Trimesh or trimesh.PointCloud

        Examples
        --------
        >>> surface.mesh().to_trimesh().is_watertight  # doctest: +SKIP
        True
        """
        import trimesh
        if not hasattr(self, "triangles"):
            return trimesh.PointCloud(np.array(self.points))
        attributes = {name: np.array(self[name]) for name in self.keys() if not name.startswith("normal_")}
        return trimesh.Trimesh(vertices=np.array(self.points), faces=np.array(self.triangles),
                               vertex_normals=np.array(_normals_of(self)), vertex_attributes=attributes,
                               process=False)

    def to_dataframe(self):
        """All fields as a pandas.DataFrame.

        Returns
        -------
        pandas.DataFrame
            x, y, z in double where they have an origin, numbers of one field as `vel_0`,
            `vel_1`, ..., names as categories.

        Examples
        --------
        >>> uvol.Samples(np.eye(3), {"hole": ["a", "b", "a"]}).to_dataframe()
             x    y    z hole
        0  1.0  0.0  0.0    a
        1  0.0  1.0  0.0    b
        2  0.0  0.0  1.0    a
        """
        import pandas
        columns = {axis: self.points[:, place] for place, axis in enumerate("xyz")}
        for name in self.keys():
            values = self[name]
            if name in self.labels:
                columns[name] = pandas.Categorical.from_codes(self.records[name], self.labels[name])
            elif values.ndim == 1:
                columns[name] = values
            else:
                columns.update((f"{name}_{place}", values[:, place]) for place in range(values.shape[1]))
        return pandas.DataFrame(columns)


def _has_normals(points):
    return all(f"normal_{axis}" in points for axis in "xyz")


def _normals_of(points):
    return np.stack([points[f"normal_{axis}"] for axis in "xyz"], axis=1)


def _to_cells(corners):
    """A vtkCellArray of cells of equally many corners."""
    from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonDataModel import vtkCellArray
    count, size = corners.shape
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, count * size + 1, size, dtype=np.int64), deep=True),
                  numpy_to_vtkIdTypeArray(np.ascontiguousarray(corners, np.int64).reshape(-1), deep=True))
    return cells


@_parameters.with_proposals
def from_vtk(dataset):
    """Samples of a vtkDataSet: its points and their data. Data of cells are left out.

    Parameters
    ----------
    dataset : vtkmodules.vtkCommonDataModel.vtkDataSet
        Points, unstructured and regular grids; of PyVista as well.

    Returns
    -------
    Samples

    Raises
    ------
    TypeError
        If `dataset` is not a vtkDataSet.

    Examples
    --------
    >>> from vtkmodules.vtkCommonDataModel import vtkImageData
    >>> grid = vtkImageData()
    >>> grid.SetDimensions(2, 3, 4)
    >>> uvol.from_vtk(grid)
    Samples of 24 points: no fields
    """
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from ._samples import Samples
    if not hasattr(dataset, "GetPointData"):
        raise TypeError(f"{_parameters.shown(dataset)} is not a vtkDataSet.")
    if not hasattr(dataset, "GetPoints"):  # a regular grid, whose points are not stored
        from vtkmodules.vtkFiltersCore import vtkAppendFilter
        append = vtkAppendFilter()
        append.AddInputData(dataset)
        append.Update()
        dataset = append.GetOutput()
    points = np.empty((0, 3), np.float32)
    if dataset.GetNumberOfPoints() > 0:
        points = vtk_to_numpy(dataset.GetPoints().GetData())
    data = dataset.GetPointData()
    fields = {}
    for number in range(data.GetNumberOfArrays()):
        array = data.GetAbstractArray(number)
        if array.IsA("vtkStringArray"):
            values = [array.GetValue(place) for place in range(array.GetNumberOfValues())]
        else:
            values = vtk_to_numpy(array)
        fields[array.GetName() or f"array_{number}"] = values
    return Samples(points, fields)
