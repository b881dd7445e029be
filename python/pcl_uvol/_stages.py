# SPDX-License-Identifier: BSD-3-Clause
"""Level sets, normals, splats, clusters, projections, Voronoi diagrams, statistics."""

import numpy as np

from . import _arrays, _core, _parameters, _report
from ._described import described
from ._pictures import Picture, pixel_sides
from ._progress import listening
from ._samples import Samples, as_samples


def _run(function, samples, parameters, threads, progress, *more):
    """Run a stage; its last results are the report, whose warnings are raised, and all parameters."""
    with listening(progress) as listener:
        results = function(samples._dataset, *more, _parameters.to_json(parameters),
                           _parameters.count(threads, "threads"), listener)
    _report.warn(results[-1]["warnings"])
    return *results, _parameters.take(results[-1])


@_parameters.with_proposals
@described(_core.describe_level_set())
def level_set(points, fields=None, *, iso, field="", scale=(1.0, 1.0, 1.0), rotate=None, start=None, snapshots=0,
              periodic=None, threads=0, progress=None, **parameters):
    """Smooth a noisy or unevenly sampled field about an isosurface (thesis, chapter 3).

    Parameters
    ----------
    {points, fields}
    iso : float
        Isovalue, in units of the field.
    {field}
    {scale, rotate}
    start : str or dict
        Initial level set: a field in units of length, or a shape: {"kind": "sphere", "first": centre,
        "radius": r}, {"kind": "box", "first": low, "second": high}, {"kind": "plane",
        "first": point, "second": normal}. By default, the values of the field.
    snapshots : int
        Keep the surface after every so many steps, in `snapshots` of the result; 0: never.
    {periodic}
    {parameters}
    {threads, progress}

    Returns
    -------
    Samples
        With the field `phi`: approximate distance to the surface, in units of length, positive
        where values are higher. `report` has mu, noise, spacing and every step. `snapshots` is a
        list of numbers of steps and samples of the surface after them.

    Raises
    ------
    DivergedError
        If the level set grows without bounds.

    Examples
    --------
    >>> import numpy as np, pcl_uvol as uvol
    >>> random = np.random.default_rng(1)
    >>> points = random.random((4000, 3))
    >>> noisy = np.linalg.norm(points - 0.5, axis=1) + 0.02 * random.standard_normal(4000)
    >>> smooth = uvol.level_set(points, {"r": noisy}, iso=0.3, mu=0.5)
    >>> surface = uvol.isosurface(smooth, field="phi", iso=0.0)
    >>> smooth.report["mu"], smooth.parameters["k"]
    (0.5, 26)
    """
    samples = as_samples(points, fields)
    stretch = _parameters.Stretch(scale, rotate)
    sides = samples._find_box(periodic)
    samples, name = samples._with_numbers(field, threads, progress, sides)
    if isinstance(start, str):
        samples, start_name = samples._with_numbers(start, threads, progress, sides)
        start = {"kind": "field", "field": start_name}
    by_field = stretch.word == "auto"
    parameters.update(field=name, isovalue=_parameters.number(iso, "iso"), rotation=stretch.rotation,
                      initial={} if start is None else _parameters.mapping(start, "start"),
                      scale=[1.0, 1.0, 1.0] if by_field else stretch.resolve(samples._dataset))
    dataset, found, report, taken = _run(_core.evolve_level_set, samples, parameters, threads, progress,
                                         _parameters.count(snapshots, "snapshots"), sides, by_field)
    result = Samples._of(dataset, report, dict(taken, snapshots=snapshots, periodic=sides))
    result.snapshots = [(steps, Samples._of(surface)) for steps, surface in found]
    return result


@_parameters.with_proposals
@described(_core.describe_normals())
def normals(points, fields=None, *, scale=(1.0, 1.0, 1.0), rotate=None, view_point=None, threads=0, progress=None, **parameters):
    """Estimate normals of a surface given as points (thesis 4.1). Normals that the points have (fields
    normal_x, normal_y, normal_z) orient the new ones.

    Parameters
    ----------
    {points, fields}
    {parameters}
    {scale, rotate of info}
    view_point : array_like, shape (3,)
        Normals of points without a normal point to this position. None: to 0, 0, 0, with a warning.
    {threads, progress}

    Returns
    -------
    Samples
        With unit normals (fields normal_x, normal_y, normal_z) and `curvature`, the share
        of the smallest principal component, from 0 to 1/3; and a `report`.

    Examples
    --------
    >>> directions = np.random.default_rng(1).standard_normal((2000, 3))
    >>> ball = uvol.Samples(directions / np.linalg.norm(directions, axis=1)[:, None])
    >>> found = uvol.normals(ball, k=12, view_point=(0, 0, 0))
    >>> normals = np.stack([found[f"normal_{axis}"] for axis in "xyz"], axis=1)
    >>> bool((np.sum(normals * ball.points, axis=1) < -0.95).all())
    True
    """
    samples = as_samples(points, fields)
    stretch = _parameters.Stretch(scale, rotate)
    parameters.update(scale=stretch.resolve(samples._dataset), rotation=stretch.rotation,
                      view_point=None if view_point is None else _parameters.numbers(view_point, "view_point"))
    return Samples._of(*_run(_core.estimate_normals, samples, parameters, threads, progress))


@_parameters.with_proposals
def splats(points, fields=None, *, delta=1e-4, delta_is_length=False, overlap=0.2, gaussians=False, color="auto",
           threads=0, progress=None):
    """Cover a surface, such as a `Surface`, with discs that have fields of normals (thesis 4.2.1). Normals are
    estimated if the points have no fields normal_x, normal_y, normal_z.

    Parameters
    ----------
    {points, fields}
    delta : float
        Largest distance between a point and its splat, relative to the longest side of the bounding
        box, outliers excluded.
    delta_is_length : bool
        `delta` is a length, in units of the coordinates.
    overlap : float
        Proportion of a splat's radius in which no other one starts, 0 to 1 (lambda in the thesis).
    gaussians : bool
        Give 3D Gaussian splats, lit. To show them in viewers, save them as ply.
    color : str
        With `gaussians`: colour by a field, "rgb" or "none". "auto": rgb if there is such a field,
        otherwise isovalue if there are several.
    {threads, progress}

    Returns
    -------
    Samples
        The splats: centres with normals, the fields of the points that they begin at,
        and a `report`.

    Examples
    --------
    >>> points = np.random.default_rng(1).random((5000, 3))
    >>> surface = uvol.isosurface(points, {"r": np.linalg.norm(points - 0.5, axis=1)}, iso=0.3)
    >>> discs = uvol.splats(surface, delta=0.001)
    >>> 0 < len(discs) < len(surface), "radius" in discs.keys()
    (True, True)
    >>> uvol.splats(surface, gaussians=True).keys()[:4]
    ['nx', 'ny', 'nz', 'f_dc_0']
    """
    gaussians = _parameters.flag(gaussians, "gaussians")
    parameters = {"delta": delta, "delta_is_length": delta_is_length, "lambda": overlap}
    found, report, taken = _run(_core.generate_splats, as_samples(points, fields), parameters, threads, progress)
    if gaussians:
        found, lost = _core.make_gaussians(found, _parameters.text(color, "color"))
        report["warnings"] += lost
        _report.warn(lost)
    return Samples._of(found, report, dict(taken, gaussians=gaussians, color=color))


class Clusters:
    """Clusters of samples.

    Attributes
    ----------
    labels : numpy.ndarray of int32, shape (n,)
        Zero-based label by decreasing size; -1: noise.
    probabilities : numpy.ndarray of float32, shape (n,)
        Probability that a sample belongs to its cluster.
    tree : dict of numpy.ndarray
        All clusters at all densities, a row each: parent, birth_density, death_density,
        size, stability, label; empty where labels were given.
    samples : Samples
        With the fields `label` and `probability`; as they were where labels were given.
    report, parameters : dict
        Counts, milliseconds and warnings; what the clusters were found with, empty where
        labels were given.

    Examples
    --------
    >>> points = np.random.default_rng(1).random((200, 3))
    >>> halves = uvol.cluster(points, labels=(points[:, 0] > 0.5).astype(int))
    >>> halves
    Clusters: 2 of 200 points, 0 of them noise
    >>> len(halves), halves.labels.shape
    (2, (200,))
    """

    def __init__(self, labels, probabilities, tree, samples, report, parameters):
        self.labels = labels
        self.probabilities = probabilities
        self.tree = tree
        self.samples = samples
        self.report = report
        self.parameters = parameters

    @_parameters.with_proposals
    def take(self, cluster):
        """The samples of a cluster.

        Parameters
        ----------
        cluster : int
            Number of the cluster, zero-based; -1: noise.

        Returns
        -------
        Samples

        Raises
        ------
        ValueError
            If the cluster does not exist.

        Examples
        --------
        >>> points = np.random.default_rng(1).random((200, 3))
        >>> halves = uvol.cluster(points, labels=(points[:, 0] > 0.5).astype(int))
        >>> bool(halves.take(1).points[:, 0].min() > 0.5)
        True
        """
        return self.samples.take(self._find_members(cluster))

    @_parameters.with_proposals
    def surface(self, cluster, kind="membership", *, probability="", smoothing_length="", cells=128, distance=0.0,
                scale=(1.0, 1.0, 1.0), rotate=None, threads=0, progress=None):
        """A surface around a cluster (thesis, Figure 2.23).

        Parameters
        ----------
        cluster : int
            Number of the cluster, zero-based.
        kind : {"membership", "distance", "hull", "hull-distance"}
            The border between its samples and the others; the surface at a distance from its points;
            their hull; the surface at a distance from this hull.
        probability : str
            With membership: a field from 0 to 1 that replaces the membership 0 or 1.
        smoothing_length : str
            With membership: a field of smoothing lengths; the SPH kernel smooths the membership.
        cells : int
            With distances: cells of the distance field along the longest side.
        distance : float
            Distance of the surface, in units of the coordinates; 0: slightly more than the longest
            edge of the minimum spanning tree of the points.
        {scale, rotate of info}
        {threads, progress}

        Returns
        -------
        Samples or tuple
            With membership, points with normals; otherwise vertices as `Samples`, and triangles,
            shape (m, 3).

        Examples
        --------
        >>> random = np.random.default_rng(1)
        >>> points = random.random((600, 3))
        >>> clusters = uvol.cluster(points, {"rho": (points[:, 0] > 0.5) + 0.05 * random.random(600)}, attributes=["rho"])
        >>> border = clusters.surface(0)
        >>> bool(np.median(abs(border.points[:, 0] - 0.5)) < 0.1)
        True
        """
        dataset = self.samples._dataset
        stretch = _parameters.Stretch(scale, rotate)
        factors = stretch.resolve(dataset)
        count = _parameters.count(threads, "threads")
        if _parameters.text(kind, "kind") == "membership":
            how = dict(cluster=cluster, probability=probability, smoothing_length=smoothing_length)
            with listening(progress) as listener:
                surface, report = _core.separate_cluster(dataset, self.labels, factors, stretch.rotation,
                                                         _parameters.to_json(how), count, listener)
            _report.warn(report["warnings"])
            space = {"scale": factors, "rotation": stretch.rotation}
            return Samples._of(surface, report, {"kind": kind, **_parameters.take(report), **space})
        if kind not in ("distance", "hull", "hull-distance"):
            raise ValueError(f"kind is {_parameters.shown(kind)}: it must be one of membership, distance, hull, hull-distance.")
        try:
            from . import _vtk
        except ImportError as error:
            raise ImportError("This build of pcl_uvol has no component VTK, which makes surfaces at distances and "
                              "hulls.") from error
        how = dict(kind=kind, cells=cells, distance=distance, scale=factors, rotation=stretch.rotation)
        members = self._find_members(cluster)
        with listening(progress) as listener:
            vertices, triangles, report = _vtk.enclose_cluster(dataset, members, _parameters.to_json(how), count,
                                                               listener)
        _report.warn(report["warnings"])
        return Samples._of(vertices, report, _parameters.take(report)), triangles

    def _find_members(self, cluster):
        """Indices of the samples of a cluster, of which there must be some."""
        members = np.flatnonzero(self.labels == cluster) if isinstance(cluster, (int, np.integer)) else []
        if len(members) == 0:
            known = f"they are numbered from 0 to {len(self) - 1}" if len(self) else "none was found"
            raise ValueError(f"The cluster {_parameters.shown(cluster)} does not exist: {known}.")
        return members

    def __len__(self):
        return int(self.labels.max(initial=-1)) + 1

    def __repr__(self):
        return f"Clusters: {len(self)} of {len(self.labels)} points, {int((self.labels < 0).sum())} of them noise"


@_parameters.with_proposals
def cluster(points, fields=None, *, attributes=(), labels=None, standardized=True, k=10, min_size=0, cut=0.0, single=False,
            threads=0, progress=None):
    """Find clusters of samples by the density of their attributes (thesis 2.6, HDBSCAN*).

    Parameters
    ----------
    {points, fields}
    attributes : sequence of str
        Fields or expressions that span the space in which the density is estimated; also "x", "y", "z".
    labels : array_like of int, shape (n,)
        Known clusters, instead of `attributes`; negative: noise.
    standardized : bool
        Divide the attributes by their standard deviations; otherwise keep their units.
    k : int
        Nearest neighbours for the estimate of the density.
    min_size : int
        Smallest number of points of a cluster; 0: 10, or the square root of the number of points
        if it is larger.
    cut : float
        Select the clusters at this distance of the attributes; 0: by persistence.
    single : bool
        Allow a single cluster of all points.
    {threads, progress}

    Returns
    -------
    Clusters

    Examples
    --------
    >>> random = np.random.default_rng(1)
    >>> a = np.repeat([0.0, 5.0], 150) + random.standard_normal(300)
    >>> found = uvol.cluster(random.random((300, 3)), {"a": a, "b": 2 * a}, attributes=["a", "b"])
    >>> len(found), found.parameters["neighbors"]
    (2, 10)

    Clusters that are known have surfaces as well:

    >>> points = random.random((200, 3))
    >>> halves = uvol.cluster(points, labels=(points[:, 0] > 0.5).astype(int))
    >>> vertices, triangles = halves.surface(1, "hull")
    >>> bool(vertices.points[:, 0].min() > 0.5)
    True
    """
    samples = as_samples(points, fields)
    attributes = _parameters.names(attributes, "attributes", "fields or expressions")
    if labels is not None:
        if attributes:
            raise ValueError("Clusters are known by labels, or found by attributes: give one of them.")
        known = _labels(labels, len(samples))
        return Clusters(known, (known >= 0).astype(np.float32), {}, samples, {"warnings": []}, _parameters.Parameters())
    samples, names = _with_attributes(samples, attributes, threads, progress)
    parameters = {"attributes": names, "is_standardized": standardized, "neighbors": k, "min_cluster_size": min_size,
                  "cut_distance": cut, "allow_single_cluster": single}
    found, probabilities, tree, labelled, *rest = _run(_core.find_clusters, samples, parameters, threads, progress)
    return Clusters(found, probabilities, tree, Samples._of(labelled), *rest)


def _labels(labels, count):
    """Numbers of clusters, one for each point."""
    array = _arrays.as_array(labels, "labels")
    if array.ndim != 1 or array.dtype.kind not in "iub" and len(array):
        raise ValueError("labels are whole numbers, one for each point.")
    if len(array) != count:
        raise ValueError(f"labels has {len(array)} numbers for {count} points.")
    if len(array) and array.max() >= 2**31:
        raise ValueError(f"labels has the number {array.max()}: it must be below 2^31.")
    return np.maximum(array.astype(np.int64), -1).astype(np.int32)


class Projection:
    """Points of many attributes in space.

    Attributes
    ----------
    places : numpy.ndarray of float32, shape (m, 3)
        Of the points that have all attributes.
    sources : numpy.ndarray, shape (m,)
        Which of the samples these are.
    labels : numpy.ndarray, shape (m,)
        Their clusters, negative for noise.
    map : dict
        names, mean, offsets and units of the attributes, and the rows of the map;
        smallest_ratio: the smallest Fisher ratio of two clusters.
    report, parameters : dict
        Counts, milliseconds and warnings; what the map was found with.

    Examples
    --------
    >>> random = np.random.default_rng(1)
    >>> samples = uvol.Samples(random.random((300, 3)), {name: random.random(300) for name in "abcd"})
    >>> halves = samples["a"] > 0.5
    >>> found = uvol.project(samples, attributes=["a", "b", "c", "d"], labels=halves, method="pca")
    >>> found
    Projection of 300 points by a, b, c, d
    >>> found.places.shape, found.map["names"]
    ((300, 3), ['a', 'b', 'c', 'd'])
    """

    def __init__(self, places, sources, labels, projection, report, parameters):
        self.places = places
        self.sources = sources
        self.labels = labels
        self.map = projection
        self.report = report
        self.parameters = parameters

    @_parameters.with_proposals
    def render(self, view="top", size=(640, 512)):
        """A picture of the points by cluster, with the axes of the attributes, as uvol_project draws it.

        Parameters
        ----------
        view : {"top", "iso", "front", "back", "left", "right", "bottom"}
        size : int or pair of int
            Pixels, width and height.

        Returns
        -------
        Picture

        Examples
        --------
        >>> random = np.random.default_rng(1)
        >>> samples = uvol.Samples(random.random((300, 3)), {name: random.random(300) for name in "abc"})
        >>> halves = samples["a"] > 0.5
        >>> uvol.project(samples, attributes=["a", "b", "c"], labels=halves, method="pca").render(size=200)
        Picture of 200 x 200 pixels
        """
        from . import _charts
        rows = np.array(self.map["rows"])
        axes = [(name, rows[:, place].tolist()) for place, name in enumerate(self.map["names"])]
        parameters = {"view": _parameters.text(view, "view"), **pixel_sides(size)}
        pixels = _charts.draw_scatter(self.places, self.labels, axes, *parameters.values())
        return Picture(pixels, "", (0.0, 1.0), self.report, parameters)

    def _repr_png_(self):
        return self.render()._repr_png_()

    def __repr__(self):
        return f"Projection of {len(self.places)} points by {', '.join(self.map['names'])}"


@_parameters.with_proposals
def project(points, fields=None, *, attributes, labels=None, standardized=True, method="star", threads=0,
            progress=None):
    """Project points of many attributes into space, so that their clusters are separate.

    Parameters
    ----------
    {points, fields}
    attributes : sequence of str
        Fields or expressions; also "x", "y", "z".
    labels : array_like of int, shape (n,)
        Known clusters, negative: noise. By default, `cluster` finds them.
    {standardized of cluster}
    method : {"star", "pca"}
        Separate the clusters as far as possible; or use the principal components.
    {threads, progress}

    Returns
    -------
    Projection

    Examples
    --------
    >>> random = np.random.default_rng(1)
    >>> groups = np.repeat([0, 1], 150)
    >>> fields = {name: 4 * groups * (name != "c") + random.standard_normal(300) for name in "abc"}
    >>> found = uvol.project(random.random((300, 3)), fields, attributes=["a", "b", "c"], labels=groups)
    >>> middles = [found.places[found.labels == group].mean(axis=0) for group in (0, 1)]
    >>> bool(np.linalg.norm(middles[0] - middles[1]) > 2)
    True
    """
    samples, names = _with_attributes(as_samples(points, fields), attributes, threads, progress)
    given = np.empty(0, np.int32) if labels is None else _labels(labels, len(samples))
    parameters = {"attributes": names, "is_standardized": standardized, "method": method}
    return Projection(*_run(_core.project_points, samples, parameters, threads, progress, given))


def _with_attributes(samples, attributes, threads, progress):
    names = []
    for attribute in _parameters.names(attributes, "attributes", "fields or expressions"):
        samples, name = samples._with_numbers(attribute, threads, progress)
        names.append(name)
    return samples, names


class VoronoiGrid:
    """The discrete Voronoi diagram of samples.

    Attributes
    ----------
    site : numpy.ndarray of uint32, shape (nz, ny, nx)
        A point in the nearest cell that holds any.
    distance : numpy.ndarray of float32, shape (nz, ny, nx)
        Between the centres of the cells, in units of the coordinates.
    origin, spacing : numpy.ndarray, shape (3,)
        Lower corner of the first cell, sides of the cells.
    report, parameters : dict

    Examples
    --------
    >>> diagram = uvol.voronoi([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], cells=(4, 1, 1))
    >>> diagram
    VoronoiGrid of 1 x 1 x 4 cells
    >>> diagram.site[0, 0], diagram.spacing.shape
    (array([0, 0, 1, 1], dtype=uint32), (3,))
    """

    def __init__(self, site, distance, origin, spacing, report, parameters):
        self.site = site
        self.distance = distance
        self.origin = np.array(origin)
        self.spacing = np.array(spacing)
        self.report = report
        self.parameters = parameters

    def __repr__(self):
        return f"VoronoiGrid of {' x '.join(map(str, self.site.shape))} cells"


@_parameters.with_proposals
def voronoi(points, fields=None, *, cells=128, margin=0, threads=0, progress=None):
    """Find the nearest point to every cell of a grid (thesis 2.1).

    Parameters
    ----------
    {points, fields}
    cells : int or three int
        Number of cubes along the longest side of the bounding box; or of boxes along x, y and z.
    margin : int
        Further cubes on each side; only with one number of cells.
    {threads, progress}

    Returns
    -------
    VoronoiGrid

    Examples
    --------
    >>> points = np.random.default_rng(1).random((50, 3))
    >>> diagram = uvol.voronoi(points, cells=32)
    >>> max(diagram.site.shape), bool((diagram.distance >= 0).all()), len(np.unique(diagram.site)) <= 50
    (32, True, True)
    """
    counts = _parameters.several(cells) or [cells, 0, 0]
    if len(counts) != 3:
        raise ValueError(f"cells has {len(counts)} numbers: it must be one, or three.")
    parameters = dict(zip(("cells_x", "cells_y", "cells_z"), counts), margin=margin)
    return VoronoiGrid(*_run(_core.compute_voronoi, as_samples(points, fields), parameters, threads, progress))


@_parameters.with_proposals
def info(points, fields=None, *, scale=(1.0, 1.0, 1.0), rotate=None, threads=0, progress=None):
    """Summarise samples: bounds, spacings, and the range of every field.

    Parameters
    ----------
    {points, fields}
    scale : sequence of three float, matrix of 3 rows, or "spacing"
        Distances are measured in a stretched space: one factor per axis, or a matrix. "spacing" or
        "auto": factors from the spacing of the samples along each axis.
    {rotate}
    {threads, progress}

    Returns
    -------
    dict
        lower, upper, spacing (min, median, max), sampling, non_finite, duplicates,
        warnings; per component of `fields` min, max, mean, finite, missing, histogram and proposed
        isovalues; and `names`: the number of different names per column of names.

    Examples
    --------
    >>> import numpy as np, pcl_uvol as uvol
    >>> facts = uvol.info(np.eye(3), {"rho": [1.0, 2.0, 6.0]})
    >>> facts["fields"]["rho"]["mean"], facts["upper"]
    (3.0, [1.0, 1.0, 1.0])
    """
    samples = as_samples(points, fields)
    stretch = _parameters.Stretch(scale, rotate)
    with listening(progress) as listener:
        facts = _core.describe_places(samples._dataset, stretch.resolve(samples._dataset), stretch.rotation,
                                      _parameters.count(threads, "threads"), listener)
    facts["points"] = len(samples)
    facts["fields"] = {}
    facts["names"] = {name: len(names) for name, names in samples.labels.items()}
    for name in [name for name in samples.keys() if name not in facts["names"]]:
        components = samples.records.dtype[name].shape
        names = [f"{name}[{place}]" for place in range(components[0])] if components else [name]
        facts["fields"].update((each, _core.describe_field(samples._dataset, each)) for each in names)
    return facts
