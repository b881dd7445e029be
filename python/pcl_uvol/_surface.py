# SPDX-License-Identifier: BSD-3-Clause
"""Isosurfaces: extraction and results."""

import base64
import html
import inspect

import numpy as np

from . import _arrays, _core, _measures, _parameters, _report
from ._pictures import Drawable
from ._points import Points
from ._progress import listening
from ._samples import as_samples


class Surface(Drawable, Points):
    """Points of one or several isosurfaces, with normals and all fields of the samples.

    Further fields are `isovalue`, `mean_curvature` (per length; positive where the enclosed side is
    convex), and

    - `error`: estimated distance to the true surface, in units of length; NaN: no estimate;
    - `support`: data coverage: 1 samples all around; 2 in a gap of the sampling; 3 at the rim of a
      gap or of the data; 4 between samples that `fill_gaps` predicted; 0 not examined;
    - `edge_length`: distance of the two samples that the point is between;
    - `method`: 1 on the edge between these samples, 2 on a local fit, 3 on the kriged surface;
    - `orientation`: source of the normal: 1 edge, 2 fit, 3 principal components, 4 edges around,
      5 slope of the kriged field.

    Attributes
    ----------
    report : dict
        Counts, milliseconds, warnings, field, isovalues, isopoints of each, scale, `scale_choice` (score of
        "auto"), error, sampling, `gaps`, and results of level sets, cross-validation and meshes.
    parameters : dict
        All parameters that were used, by the library's names. print() shows one per line.

    Examples
    --------
    >>> points = np.random.default_rng(1).random((5000, 3))
    >>> r = np.linalg.norm(points - 0.5, axis=1)
    >>> surface = uvol.isosurface(points, {"r": r, "vel": points}, field="r", iso=0.3, outside="higher")
    >>> surface["vel"].shape == surface.points.shape, surface.parameters["normals"]
    (True, 'auto')
    >>> bool(surface.report["error"]["median"] < 1e-3)
    True
    """

    def __init__(self, dataset, report, parameters, samples):
        super().__init__(dataset)
        self.report = report
        self.parameters = parameters
        self._samples = samples

    @property
    def normals(self):
        """numpy.ndarray of float32, shape (n, 3): unit vectors to the outside, a view.

        Examples
        --------
        >>> points = np.random.default_rng(1).random((5000, 3))
        >>> surface = uvol.isosurface(points, {"a": points[:, 0]}, iso=0.5, outside="higher")
        >>> bool(np.median(surface.normals[:, 0]) > 0.999), np.shares_memory(surface.normals, surface.records)
        (True, True)
        """
        return _arrays.view_axes(self.records, ("normal_x", "normal_y", "normal_z"))

    @_parameters.with_proposals
    def mesh(self, remesh="even", edge_length=0.0, open=False, drop_pieces=0, threads=0, progress=None):
        """Closed triangle meshes of the same isovalues, from the same samples.

        Parameters
        ----------
        remesh : {"even", "none"}
            Remesh to isotropic triangles, or keep the raw triangles between the cells.
        edge_length : float
            Approximate edge length of even triangles, in units of the coordinates; 0: the local
            spacing. Edges are not made shorter than the spacing of the samples.
        open : bool
            Leave the surface open at the border of the samples. By default, caps close it.
        drop_pieces : int
            Remove pieces of fewer triangles.
        {threads, progress}

        Returns
        -------
        Mesh

        Raises
        ------
        ValueError
            If the surface has no samples, because it was pickled.

        Examples
        --------
        >>> points = np.random.default_rng(1).random((5000, 3))
        >>> r = np.linalg.norm(points - 0.5, axis=1)
        >>> mesh = uvol.isosurface(points, {"r": r}, iso=0.3, outside="higher").mesh()
        >>> len(mesh.vertices) - 3 * len(mesh.triangles) // 2 + len(mesh.triangles)  # of Euler
        2
        """
        if self._samples is None:
            raise ValueError("This surface has lost its samples, as pickled ones do: extract it with mesh=True.")
        meshing = dict(remesh=remesh, edge_length=edge_length, open=open, drop_pieces=drop_pieces)
        parameters = dict(self.parameters, mesh=meshing, max_error=None, automatic_max_error=False,
                          drop_bridged=False, validation={"folds": 0})
        return _extract(_core.Extractor(), self._samples, parameters, threads, progress)

    @_parameters.with_proposals
    def measure(self, curved=True, find_intersections=False, threads=0, progress=None, *, drop_uncertain=False):
        """Area, volume, axes, genus and integrals of fields of the closed mesh `mesh()`, each with its
        error. To measure the points instead, use `pcl_uvol.measure`.

        Parameters
        ----------
        {others of measure}

        Returns
        -------
        Measures
            The measures of the first isovalue. Its `isovalues` has all.

        Examples
        --------
        >>> import numpy as np, pcl_uvol as uvol
        >>> points = np.random.default_rng(1).random((20000, 3))
        >>> r = np.linalg.norm(points - 0.5, axis=1)
        >>> figures = uvol.isosurface(points, {"r": r}, iso=0.3, outside="higher").measure()
        >>> bool(abs(figures.volume.value - 4 / 3 * np.pi * 0.3**3) < 1e-4), figures.genus
        (True, 0)
        """
        return self.mesh(threads=threads, progress=progress).measure(curved, find_intersections, threads, progress,
                                                                    drop_uncertain=drop_uncertain)

    def _comments(self):
        taken = self.parameters["isosurface"]
        isovalues = ",".join(f"{value:g}" for value in taken["isovalues"])
        return [f"isosurface of {taken['field']} at {isovalues}"]

    def __getstate__(self):
        state = super().__getstate__()
        state["_samples"] = None
        return state

    def _describe(self):
        taken = self.parameters["isosurface"]
        values = ", ".join(f"{value:g}" for value in taken["isovalues"])
        return f"{type(self).__name__} of {taken['field']} at {values}: {len(self)} points"

    def __repr__(self):
        return self._describe()

    def _repr_png_(self):
        return self.render(size=(640, 480))._repr_png_() if len(self) > 0 else None

    def _repr_html_(self):
        """A picture, counts and warnings: what a notebook shows."""
        picture = self._repr_png_()
        image = base64.b64encode(picture).decode() if picture else ""
        lines = [f"<b>{html.escape(self._describe())}</b>"]
        if "error" in self.report:
            lines.append("estimated error: median {median:.3g}, 95 % within {percentile_95:.3g}".format(
                **self.report["error"]))
        lines += [f"&#9888; {html.escape(warning['text'])}" for warning in self.report["warnings"]]
        if image:
            lines.append(f'<img src="data:image/png;base64,{image}">')
        return "<br>".join(lines)


class Mesh(Surface):
    """A triangle mesh of one or several isosurfaces; its vertices are isopoints.

    Further fields are `piece`, the connected piece of each vertex, and `cap`: 1 where a vertex closes
    the surface at the border of the samples. `report["pieces"]` has triangles, rims and genus of each.

    Attributes
    ----------
    triangles : numpy.ndarray of uint32, shape (m, 3)
        Indices of vertices, counter-clockwise as seen from outside.

    Examples
    --------
    >>> points = np.random.default_rng(1).random((5000, 3))
    >>> r = np.linalg.norm(points - 0.5, axis=1)
    >>> mesh = uvol.isosurface(points, {"r": r}, iso=[0.2, 0.4], outside="higher", mesh=True)
    >>> mesh.triangles.dtype, [piece["genus"] for piece in mesh.report["pieces"]]
    (dtype('uint32'), [0, 0])
    """

    def __init__(self, dataset, triangles, report, parameters, samples):
        super().__init__(dataset, report, parameters, samples)
        triangles.flags.writeable = False
        self.triangles = triangles

    @property
    def vertices(self):
        """numpy.ndarray, shape (n, 3): the points.

        Examples
        --------
        >>> points = np.random.default_rng(1).random((5000, 3))
        >>> r = np.linalg.norm(points - 0.5, axis=1)
        >>> mesh = uvol.isosurface(points, {"r": r}, iso=0.3, outside="higher", mesh=True)
        >>> mesh.vertices is mesh.points, mesh.vertices[mesh.triangles].shape == (len(mesh.triangles), 3, 3)
        (True, True)
        """
        return self.points

    @_parameters.with_proposals
    def measure(self, curved=True, find_intersections=False, threads=0, progress=None, *, drop_uncertain=False):
        """Area, volume, axes, genus and integrals of fields, each with its error.

        Parameters
        ----------
        {others of measure}

        Returns
        -------
        Measures
            The measures of the first isovalue. Its `isovalues` has all.

        Examples
        --------
        >>> points = np.random.default_rng(1).random((20000, 3))
        >>> r = np.linalg.norm(points - 0.5, axis=1)
        >>> mesh = uvol.isosurface(points, {"r": r}, iso=0.3, outside="higher", mesh=True)
        >>> bool(abs(mesh.measure().area.value - 4 * np.pi * 0.3**2) < 1e-3)
        True
        """
        return _measures.measure(self, curved=curved, find_intersections=find_intersections,
                                 drop_uncertain=drop_uncertain, threads=threads, progress=progress)

    @_parameters.with_proposals
    def save(self, path, ascii=False, progress=None):
        """Write a mesh as ply, vtp, vtkhdf, obj, off or stl, by the ending of the name.

        Parameters
        ----------
        path : str or os.PathLike
        ascii : bool
            Write PLY as text.
        progress : bool or callable
            It has no effect, because files of meshes report no progress.

        Examples
        --------
        >>> import tempfile
        >>> path = tempfile.mkdtemp() + "/sphere.obj"
        >>> points = np.random.default_rng(1).random((5000, 3))
        >>> r = np.linalg.norm(points - 0.5, axis=1)
        >>> mesh = uvol.isosurface(points, {"r": r}, iso=0.3, outside="higher", mesh=True)
        >>> mesh.save(path)
        >>> bool((uvol.read_mesh(path)[1] == mesh.triangles).all())
        True
        """
        self._save(path, self.triangles, ascii, progress)

    def _describe(self):
        return f"{super()._describe()}, {len(self.triangles)} triangles"


class Extractor:
    """Extracts isosurfaces of samples, and keeps the tree for further ones.

    Parameters
    ----------
    {points, fields}

    Attributes
    ----------
    samples : Samples
    parameters : dict
        Of the latest extraction, at first the library's defaults.

    Examples
    --------
    >>> import numpy as np, pcl_uvol as uvol
    >>> points = np.random.default_rng(1).random((5000, 3))
    >>> extractor = uvol.Extractor(points, {"r": np.linalg.norm(points - 0.5, axis=1)})
    >>> for iso in (0.2, 0.3, 0.4):
    ...     surface = extractor.extract(iso=iso, outside="higher")
    >>> print(extractor.parameters)  # doctest: +ELLIPSIS
    isosurface.field = 'r'
    isosurface.isovalues = [0.4]
    ...
    """

    @_parameters.with_proposals
    def __init__(self, points, fields=None):
        self.samples = as_samples(points, fields)
        self.parameters = _parameters.from_json(_core.Extractor.default_parameters)
        self._extractor = _core.Extractor()

    @_parameters.with_proposals
    def extract(self, *, iso, field="", scale=None, rotate=None, outside="lower", interpolation="auto",
                neighbors="kdtree", voronoi_cells=0, criterion="kept", smooth=False, mu=None, level_set=None,
                normals="auto", normal_neighbors=30, max_error=None, drop_bridged=False, fill_gaps=False,
                outside_value=None, validate=0, validate_by="random", mesh=False, periodic=None,
                periodic_mesh="cut", threads=0, progress=None):
        """Extract the isosurfaces of a field.

        Parameters
        ----------
        {others of isosurface}

        Returns
        -------
        Surface
            A `Mesh` if `mesh` is given.

        Examples
        --------
        >>> points = np.random.default_rng(1).random((5000, 3))
        >>> extractor = uvol.Extractor(points, {"r": np.linalg.norm(points - 0.5, axis=1), "a": points[:, 0]})
        >>> extractor.extract(iso=0.3, field="r").report["field"], extractor.extract(iso=0.5, field="a").report["field"]
        ('r', 'a')
        """
        sides = self.samples._find_box(periodic)
        samples, field = self.samples._with_numbers(field, threads, progress, sides)
        stretch = _parameters.Stretch((1.0, 1.0, 1.0) if scale is None else scale, rotate)
        by_field = stretch.word == "auto"
        parameters = {
            "isosurface": {
                "field": field,
                "isovalues": _parameters.numbers(iso, "iso"),
                "outside": outside,
                "interpolation": interpolation,
                "neighbors": neighbors,
                "voronoi_cells": voronoi_cells,
                "criterion": criterion,
                "scale": [1.0, 1.0, 1.0] if by_field else stretch.resolve(samples._dataset),
            },
            "automatic_scale": None if scale is None else by_field,
            "rotation": stretch.rotation,
            "smooth": smooth,
            "level_set": {**_parameters.mapping(level_set, "level_set"), **({} if mu is None else {"mu": mu})},
            "normals": normals,
            "normal_neighbors": normal_neighbors,
            "max_error": None if _is_auto(max_error) else max_error,
            "automatic_max_error": _is_auto(max_error),
            "drop_bridged": drop_bridged,
            "fill_gaps": _parameters.flag(fill_gaps, "fill_gaps"),
            "outside_value": outside_value,
            "validation": _validation(validate, validate_by),
            "mesh": _meshing(mesh),
            "periodic": sides,
            "periodic_mesh": periodic_mesh,
        }
        surface = _extract(self._extractor, samples, parameters, threads, progress)
        self.parameters = surface.parameters
        return surface

    def __reduce__(self):
        return Extractor, (self.samples,)

    def __repr__(self):
        return f"Extractor of {self.samples!r}"


def _is_auto(max_error):
    """Whether the bound of the error is to be found from the samples."""
    return isinstance(max_error, str) and max_error == "auto"


def _meshing(mesh):
    """Parameters of meshes; None: there is to be none."""
    if mesh is None or isinstance(mesh, (bool, np.bool_)):
        return {} if mesh else None
    return _parameters.mapping(mesh, "mesh")


def _validation(folds, by):
    if _parameters.text(by, "validate_by") in ("random", "blocks"):
        return {"folds": folds, "by": by}
    return {"folds": folds, "by": "field", "field": by}


def _extract(extractor, samples, parameters, threads, progress):
    """A surface, or with parameters of one a mesh."""
    with listening(progress) as listener:
        dataset, triangles, report = extractor.extract(samples._dataset, _parameters.to_json(parameters),
                                                       _parameters.count(threads, "threads"), listener)
    taken = _parameters.take(report)
    if taken["mesh"] is None:
        surface = Surface(dataset, report, taken, samples)
    else:
        surface = Mesh(dataset, triangles, report, taken, samples)
    _report.warn(report["warnings"])
    return surface


@_parameters.with_proposals
def isosurface(points, fields=None, **options):
    """Extract isosurfaces of a scalar field given at scattered points.

    Parameters
    ----------
    points : array_like, shape (n, 3), or Samples
        Coordinates, float32 or float64. `Samples` bring their fields along.
    fields : mapping of str to array_like
        Values at the points, shape (n,) or (n, k). NaN is a missing value. See `Samples`.
    iso : float or sequence of float
        Isovalues, in units of the field.
    field : str
        Name of a field, `vel[1]`, `|vel|`, or an expression such as `log10(rho)`.
        "": `intensity`, otherwise the only candidate.
    scale : sequence of three float, matrix of 3 rows, "auto" or "spacing"
        Distances are measured in a stretched space: one factor per axis, or a matrix. "auto":
        factors from the change of the field along each axis; "spacing": from the spacing of the
        samples along each axis. By default, all factors are 1.
    rotate : sequence of three float
        Strike, dip and plunge of the axes of `scale`, in degrees; x is east, y is north. The second
        axis is a line that plunges in a plane that dips. The third axis is the plane's normal.
    outside : {"lower", "higher"}
        Where the outside is, to which normals point: "lower" if it has the lower values, as around
        a high density; "higher" if it has the higher values, as of a distance to a centre.
    interpolation : {"auto", "fit", "linear"}
        Place isopoints on local polynomial fits, or by linear interpolation on the edges between
        samples. "auto" decides for each point.
    neighbors : {"kdtree", "voronoi", "exact"}
        Find neighbours in a k-d tree, in a discrete Voronoi diagram, or by the exact Voronoi cells
        (natural neighbours). "exact" is much slower; use it with `criterion="none"`.
    voronoi_cells : int
        Cells of `neighbors="voronoi"` along the longest side; 0: 4 samples per cell.
    criterion : {"kept", "all", "none"}
        Angle criterion: closer candidates that can remove a farther neighbour: the kept ones, all, or none.
    smooth : bool
        Smooth noisy or uneven samples by a level set first.
    mu : float
        With `smooth`: weight of the data against smoothness, 0 to 1. By default from the values.
    level_set : dict
        With `smooth`: further parameters of `level_set`, such as {"max_steps": 100}.
    normals : {"auto", "fit", "pca", "edge"}
        "pca": principal components of the isopoints; "fit": local fits, or principal components where
        there is no fit; "edge": local fits, or the direction of the edge. "auto" selects by sampling.
    normal_neighbors : int
        Isopoints per normal by principal components.
    max_error : float or "auto"
        Remove isopoints with a larger `error`, in units of length. "auto": larger than half of the
        distance between the two samples of the isopoint, or half of a filled gap. Crossings with
        lines of samples are kept.
    drop_bridged : bool
        Remove isopoints in gaps of the sampling (`support` 2).
    fill_gaps : bool
        Predict samples between lines or sheets of samples by kriging, and extract from both.
        Predictions end at the range of the variogram and half a gap outside of the convex hull of
        all samples. Isopoints there have `support` 4. Their `error` is the kriging standard
        deviation divided by the slope. Their `confidence` is the proportion of the variance that the
        samples explain; if it is 0, interpolation "auto" removes them. `scale` is "auto" by default then.
    outside_value : float
        Value of the field outside of the data, where it is known to end there, such as the density
        of a liquid. Samples of that value are added about one spacing outside of the others (see
        `Samples.outer_layer`), and surfaces are closed there. Interpolation "auto" is then "linear",
        except for meshes.
    validate : int
        Parts of a cross-validation, at least 2; 0: none.
    validate_by : str
        Parts are "random", compact "blocks", or the samples that share a value of the field of this name.
    mesh : bool or dict
        Make closed triangle meshes. A dictionary has parameters of `Surface.mesh`.
    periodic : sequence of three float, or "header"
        Sides of the periodic box, in units of length; 0 along an axis that is not periodic.
        "header": the sides that the file names (`Samples.box`). Neighbours are found across its
        faces. It cannot be combined with `rotate`.
    periodic_mesh : {"cut", "weld"}
        With `mesh` and `periodic`. "cut": the mesh ends at the faces of the box. "weld": rims in
        opposite faces get the same vertices. The field `image_of` is the index of the vertex that
        each is the image of: `mesh["image_of"][mesh.triangles]` is closed across the faces.
    threads : int
        Number of threads; 0 uses all cores. The result does not depend on it.
    progress : bool or callable
        True shows a progress bar. A function is called as progress(step, done), done from 0 to 1.

    Returns
    -------
    Surface
        A `Mesh` if `mesh` is given. `Surface` explains its fields, such as `error` and `support`.

    Raises
    ------
    ValueError
        If an array or a parameter is not valid.
    FieldError
        A KeyError, if the field does not exist.
    MemoryError
        Before the work begins, if it needs more memory than is available.

    Examples
    --------
    >>> import numpy as np, pcl_uvol as uvol
    >>> points = np.random.default_rng(1).random((20000, 3))
    >>> r = np.linalg.norm(points - 0.5, axis=1)
    >>> surface = uvol.isosurface(points, {"r": r}, iso=0.3, outside="higher")
    >>> bool(abs(np.linalg.norm(surface.points - 0.5, axis=1) - 0.3).max() < 1e-3)
    True
    >>> surface.normals.shape == surface.points.shape
    True
    """
    return Extractor(points, fields).extract(**options)


def _show_options():
    """Let help() and editors show the keywords of extract() as those of isosurface()."""
    own = list(inspect.signature(isosurface).parameters.values())[:-1]
    keywords = list(inspect.signature(Extractor.extract).parameters.values())[1:]
    isosurface.__signature__ = inspect.Signature(own + keywords)


_show_options()
