# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of surfaces, drawn without a display."""

import copy
import os
import tempfile

import numpy as np

from . import _parameters, _report
from ._progress import listening

_OWN_COLORS = ("auto", "none", "rgb", "rgba")


class Picture:
    """A picture; a notebook shows it.

    Attributes
    ----------
    pixels : numpy.ndarray of uint8, shape (height, width, 4)
        Red, green, blue and opacity, the first row on top.
    field : str
        Name of the field that gives the colours; "" for the colour of the surface.
    range : tuple of float
        The values at the ends of the colours.
    report : dict
        Counts, milliseconds and warnings.
    parameters : dict
        All that it was drawn with.

    Examples
    --------
    >>> points = np.random.default_rng(1).random((5000, 3))
    >>> picture = uvol.isosurface(points, {"a": points[:, 0]}, iso=0.5).render(size=(120, 80), color="none")
    >>> picture, np.asarray(picture).shape, picture.parameters["fov"]
    (Picture of 120 x 80 pixels, (80, 120, 4), 30.0)
    """

    def __init__(self, pixels, field, limits, report, parameters):
        self.pixels = pixels
        self.field = field
        self.range = tuple(limits)
        self.report = report
        self.parameters = _parameters.Parameters(parameters)

    def __array__(self, dtype=None):
        return self.pixels if dtype is None else self.pixels.astype(dtype)

    @_parameters.with_proposals
    def save(self, path, dpi=0.0):
        """Write a PNG file, as the tools do.

        Parameters
        ----------
        path : str or os.PathLike
        dpi : float
            Dots per inch that the file says it is printed with; 0: it says nothing.

        Examples
        --------
        >>> import tempfile
        >>> points = np.random.default_rng(1).random((5000, 3))
        >>> picture = uvol.isosurface(points, {"a": points[:, 0]}, iso=0.5).render(size=64)
        >>> picture.save(tempfile.mkdtemp() + "/surface.png")
        """
        from . import _io
        _io.write_png(os.fsencode(path), self.pixels, dpi)

    def _repr_png_(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "picture.png")
            self.save(path)
            with open(path, "rb") as file:
                return file.read()

    def __repr__(self):
        height, width = self.pixels.shape[:2]
        by = f", {self.field} from {self.range[0]:g} to {self.range[1]:g}" if self.field not in ("", "rgb") else ""
        return f"Picture of {width} x {height} pixels{by}"


def pixel_sides(size):
    """Width and height."""
    sides = _parameters.several(size) or [size, size]
    if len(sides) != 2:
        raise ValueError(f"size is {_parameters.shown(size)}: it must be a number of pixels, or width and height.")
    width, height = (_parameters.count(side, "size") for side in sides)
    if min(width, height) < 1:  # below, this would ask for the usual size
        raise ValueError(f"The image size {width} x {height} is not allowed: it must be 1 x 1 to 16384 x 16384 pixels.")
    return {"width": width, "height": height}


def _place(value, what):
    return None if value is None else _parameters.numbers(value, what)


def look_of(size, view, eye, at, up, fov, parallel, zoom, background, supersample):
    """What all pictures are asked for with, scenes as well."""
    look = dict(view=view, eye=_place(eye, "eye"), at=_place(at, "at"), up=_place(up, "up"), fov=fov,
                parallel=_parameters.flag(parallel, "parallel"), zoom=zoom,
                supersample=_parameters.count(supersample, "supersample"), **pixel_sides(size))
    if isinstance(background, str):
        look["background"] = background
    else:
        look["background_color"] = _place(background, "background")
    return look


def _lights(directions):
    """Rows of three numbers."""
    rows = np.asarray([] if directions is None else directions, dtype=object)
    return [_place(row, "lights") for row in np.atleast_2d(rows).tolist() if len(row)]


def _figure(ticks, box, triad, scale_bar, unit, title, views):
    """What explains a picture."""
    shown = dict(ticks=ticks, box=box, triad=triad, scale_bar=scale_bar)
    return dict({name: _parameters.flag(value, name) for name, value in shown.items()},
                unit=_parameters.text(unit, "unit"), title=_parameters.text(title, "title"),
                views=_parameters.names(views, "views", "sides"))


class Drawable:
    """What can be drawn: points with normals."""

    _frames = None  # of a full turn; None: one picture

    @_parameters.with_proposals
    def render(self, *, color="auto", colormap="auto", range=None, log=False, bar=True, size=(1024, 1024), view="iso",
               eye=None, at=None, up=None, fov=30.0, parallel=False, zoom=1.0, background="white", surface_color=None, exaggerate=None,
               opacity=None, lights=None, material=None, supersample=0, culling=False, footprints=True,
               silhouettes=False, features=False, thickness=2, line_color=None, ticks=False, box=False, triad=False,
               scale_bar=False, unit="", title="", views=(), passes=None, threads=0, progress=None):
        """Draw the points in image space (thesis 4.3).

        Parameters
        ----------
        color : str
            A field (a vector is shown by its length), an expression, "rgb" or "none". "auto": rgb if
            there is such a field, otherwise isovalue if there are several.
        colormap : {"auto", "viridis", "cividis", "inferno", "magma", "plasma", "turbo", "gray", "coolwarm", "RdBu", "PuOr", "twilight", "OkabeIto", "tab10"}
            "auto" (not for slices): OkabeIto for up to eight integers, tab10 for ten, otherwise viridis.
            A name with "_r", such as "RdBu_r", reverses the colours.
        range : pair of float
            Values at the ends of the colours; by default the range of the field.
        log : bool
            Colour by the logarithm of the values.
        bar : bool
            Draw the colour bar.
        size : int or pair of int
            Width and height, pixels.
        view : {"iso", "front", "back", "left", "right", "top", "bottom"}
            Side from which the surface is seen.
        eye, at, up : array_like, shape (3,)
            Position of the camera, which replaces `view`; position at the centre of the picture (by
            default the centre of the surface); direction that is upwards (by default z).
        fov : float
            Vertical field of view, degrees.
        parallel : bool
            Parallel projection. With `eye`, its scale is the scale of a perspective at `at`.
        zoom : float
            Factor that enlarges the centre of the picture.
        background : {"white", "black", "gradient", "transparent"}, or a colour
            A colour is red, green and blue, 0 to 1.
        surface_color : array_like, shape (3,)
            Colour of points without a colour: red, green and blue, 0 to 1.
        exaggerate : array_like, shape (3,)
            Factors that stretch the picture along x, y and z. `eye` and `at` are not stretched.
        opacity : float or sequence of float
            Opacity of all isovalues, or of each one, lowest first: 0 transparent, 1 opaque.
        lights : array_like, shape (n, 3)
            Directions towards the lights: x right, y up, z to the viewer.
        material : dict
            Factors of the light: ambient, diffuse, specular; and shininess, the exponent of highlights.
        supersample : int
            Samples per pixel in each direction; 0: automatic (`render` 2, `raytrace` 1).
        culling : bool
            Omit surfaces that face away from the camera.
        footprints : bool
            Draw points as discs where their distance is more than a pixel.
        silhouettes, features : bool
            Draw silhouettes; draw feature lines.
        thickness : int
            Thickness of silhouettes, 1 to 7: t for 2 t - 1 pixels.
        line_color : array_like, shape (3,)
            Colour of lines: red, green and blue, 0 to 1; by default black.
        ticks, box, triad, scale_bar : bool
            Draw axes with values and grid lines; the box around the surface; the directions of x, y
            and z; a bar of a round length, which is true at the centre of the surface.
        unit, title : str
            Unit of the coordinates, such as km, for axes and scale bar; a line above the picture.
        views : sequence of str
            Several views in one picture, such as ("iso", "top"); they replace `view`.
        passes : dict
            Rarely used: fill, occluded, layers, shading, occlusion (0 to 1: ambient light that walls
            around block), smoothing ("none", "box", "gaussian", "alleviated"), smoothings,
            silhouette_threshold, feature_threshold, antialias, antialias_threshold.
        {threads, progress}

        Returns
        -------
        Picture

        Examples
        --------
        >>> points = np.random.default_rng(1).random((5000, 3))
        >>> surface = uvol.isosurface(points, {"r": np.linalg.norm(points - 0.5, axis=1)}, iso=[0.2, 0.4])
        >>> picture = surface.render(size=(320, 200), opacity=[1, 0.4], ticks=True, unit="m", views=("iso", "top"))
        >>> picture.pixels.shape, picture.field
        ((200, 320, 4), 'isovalue')
        """
        look = look_of(size, view, eye, at, up, fov, parallel, zoom, background, supersample)
        look.update(self._colors(color, colormap, range, log, bar, surface_color, exaggerate, lights, material),
                    culling=culling, footprints=footprints, silhouettes=silhouettes, features=features,
                    thickness=thickness, line_color=_place(line_color, "line_color"), passes=_parameters.mapping(passes, "passes"),
                    opacity=[] if opacity is None else _parameters.numbers(opacity, "opacity"),
                    **_figure(ticks, box, triad, scale_bar, unit, title, views))
        return self._draw(look, None, threads, progress)

    @_parameters.with_proposals
    def raytrace(self, *, color="auto", colormap="auto", range=None, log=False, bar=True, size=(1024, 1024),
                 view="iso", eye=None, at=None, up=None, fov=30.0, parallel=False, zoom=1.0, background="white", surface_color=None,
                 exaggerate=None, lights=None, material=None, supersample=0, depth=4, shadows=True, light_samples=16,
                 occlusion=0, occlusion_distance=0.0, reflect=0.0, transparent=0.0, index=1.0, culling=False, splats=None,
                 ticks=False, box=False, triad=False, scale_bar=False, unit="", title="", views=(), threads=0, progress=None):
        """Draw the points by ray tracing of splats (thesis 4.2): shadows, mirrors, glass.

        Parameters
        ----------
        depth : int
            Largest number of reflections and refractions of a ray.
        shadows : bool
            Draw shadows.
        light_samples : int
            Shadow rays to a light that has a radius.
        occlusion : int
            Rays that estimate the ambient light at a position; 0: no occlusion.
        occlusion_distance : float
            Length beyond which nothing blocks ambient light; 0: a fifth of the radius of the scene.
        reflect, transparent : float
            Proportions of the light that are reflected, and transmitted, 0 to 1.
        index : float
            Refractive index of the inside.
        splats : dict
            Parameters of `splats`, by the library's names: delta, delta_is_length, lambda.
        {others of Drawable.render}

        Returns
        -------
        Picture

        Examples
        --------
        >>> points = np.random.default_rng(1).random((5000, 3))
        >>> surface = uvol.isosurface(points, {"r": np.linalg.norm(points - 0.5, axis=1)}, iso=0.3)
        >>> surface.raytrace(size=(80, 60), color="none", reflect=0.3, occlusion=4)
        Picture of 80 x 60 pixels
        """
        look = look_of(size, view, eye, at, up, fov, parallel, zoom, background, supersample)
        look.update(self._colors(color, colormap, range, log, bar, surface_color, exaggerate, lights, material),
                    **_figure(ticks, box, triad, scale_bar, unit, title, views))
        rays = dict(depth=depth, shadows=shadows, light_samples=light_samples, occlusion=occlusion,
                    occlusion_distance=occlusion_distance, reflect=reflect, transparent=transparent, index=index,
                    culling=culling, splats=None if splats is None else _parameters.mapping(splats, "splats"))
        return self._draw(look, _parameters.to_json(rays), threads, progress)

    def orbit(self, frames, *, raytraced=False, **options):
        """Draw the frames of a full turn about `up`. Each one is drawn when it is requested.

        Parameters
        ----------
        frames : int
            Number of frames, at least 1.
        raytraced : bool
            Draw with `raytrace` instead of `render`.
        **options
            Parameters of `raytrace` or `render`.

        Returns
        -------
        iterator of Picture

        Examples
        --------
        >>> points = np.random.default_rng(1).random((5000, 3))
        >>> surface = uvol.isosurface(points, {"a": points[:, 0]}, iso=0.5)
        >>> frames = [picture.pixels for picture in surface.orbit(4, size=64, color="none")]
        >>> len(frames), bool(np.array_equal(frames[0], frames[2]))
        (4, False)
        """
        draw = Drawable.raytrace if raytraced else Drawable.render
        known = _parameters.keywords_of(Drawable.orbit)[0] + _parameters.keywords_of(draw)[0]
        _parameters.check_keywords("orbit", known, options)
        turning = copy.copy(self)
        turning._frames = _parameters.count(frames, "frames")
        return draw(turning, **options)

    def _colors(self, color, colormap, range, log, bar, surface_color, exaggerate, lights, material):
        """What points with fields are asked for with."""
        if not isinstance(color, str):
            raise TypeError(f"color is {_parameters.shown(color)}: it must be the name of a field, or an expression.")
        _parameters.text(color, "color")
        if color in self.keys() and self.records.dtype[color].shape:
            color = f"|{color}|"
        return dict(color=color or "none", colormap=colormap, log=_parameters.flag(log, "log"), bar=_parameters.flag(bar, "bar"),
                    range=None if range is None else _parameters.numbers(range, "range"),
                    exaggerate=_place(exaggerate, "exaggerate"), surface_color=_place(surface_color, "surface_color"),
                    lights=_lights(lights), material=_parameters.mapping(material, "material"))

    @_parameters.with_proposals
    def save_page(self, path, *, color="auto", colormap="auto", range=None, log=False, bar=True, view="iso", eye=None,
                  at=None, up=None, fov=30.0, parallel=False, zoom=1.0, background="white", surface_color=None, exaggerate=None,
                  lights=None, material=None, threads=0, progress=None):
        """Write the points as a web page: one file that any browser shows and turns, without a server
        or a network, as uvol_render writes it.

        Parameters
        ----------
        path : str or os.PathLike
            Ends in .html.
        {others of Drawable.render}

        Returns
        -------
        dict
            The report: counts, milliseconds and warnings.

        Examples
        --------
        >>> import tempfile
        >>> points = np.random.default_rng(1).random((5000, 3))
        >>> surface = uvol.isosurface(points, {"a": points[:, 0]}, iso=0.5)
        >>> surface.save_page(tempfile.mkdtemp() + "/surface.html", color="none")["warnings"]
        []
        """
        from . import _charts
        path = os.fsdecode(path)
        if not path.endswith(".html"):
            raise ValueError(f"{path!r} is not a web page: its name must end in .html.")
        look = look_of(1024, view, eye, at, up, fov, parallel, zoom, background, 0)
        look.update(self._colors(color, colormap, range, log, bar, surface_color, exaggerate, lights, material))
        count = _parameters.count(threads, "threads")
        dataset = self._find_colors(look["color"], count)
        with listening(progress) as listener:
            report = _charts.write_page(os.fsencode(path), dataset, _parameters.to_json(look), count, listener)
        _report.warn(report["warnings"])
        return report

    def _find_colors(self, color, threads):
        """The points, with the field that colours them if it is an expression."""
        if color in _OWN_COLORS:
            return self._dataset
        because = "from points on a surface, but from samples: Samples.compute adds them there"
        return self._dataset.with_field(color, because, [0.0] * 3, threads, None)[0]

    def _draw(self, look, rays, threads, progress):
        """A picture of these points, or the frames of a turn."""
        from . import _charts
        count = _parameters.count(threads, "threads")
        dataset = self._find_colors(look["color"], count)
        look = _parameters.to_json(dict(look, frames=1 if self._frames is None else self._frames))
        with listening(progress) as listener:
            painter = _charts.Painter(dataset, look, rays, count, listener)
        pictures = (_draw_frame(painter, frame, progress) for frame in range(self._frames or 1))
        return next(pictures) if self._frames is None else pictures


def _draw_frame(painter, frame, progress):
    with listening(progress) as listener:
        pixels, field, limits, report = painter.draw(frame, listener)
    parameters = _parameters.take(report)
    parameters.update(_parameters.from_json(report.pop("ray_parameters", "{}")))
    _report.warn(report["warnings"])
    return Picture(pixels, field, limits, report, parameters)


@_parameters.with_proposals
def raytrace(scene, *, folder="", size=None, view=None, eye=None, at=None, up=None, fov=None, parallel=False, zoom=1.0, turn=0.0,
             background=None, lights=None, supersample=None, depth=None, shadows=None, light_samples=None,
             occlusion=None, occlusion_distance=None, culling=None, threads=0, progress=None):
    """Draw a scene of uvol_raytrace: surfaces of several files with their materials, lights and a camera.

    Parameters that are given replace those of the scene: `view` the whole camera; eye, at, up and fov
    single properties of it.

    Parameters
    ----------
    scene : str or os.PathLike
        A text file that lists the items of the scene.
    folder : str or os.PathLike
        Folder of its clouds; "": the folder of the scene.
    turn : float
        Angle by which the camera turns about the position that it faces, degrees, counter-clockwise
        as seen from above. For a full turn, use `np.arange(0, 360, 10)`.
    {others of Drawable.raytrace}

    Returns
    -------
    Picture

    Examples
    --------
    >>> import os, tempfile
    >>> folder = tempfile.mkdtemp()
    >>> points = np.random.default_rng(1).random((5000, 3))
    >>> uvol.isosurface(points, {"a": points[:, 0]}, iso=0.5).save(os.path.join(folder, "plane.ply"))
    >>> path = os.path.join(folder, "plane.scene")
    >>> with open(path, "w") as file:
    ...     _ = file.write("background 0.2 0.3 0.4\\ncloud plane.ply\\n")
    >>> uvol.raytrace(path, size=(80, 60), view="front")
    Picture of 80 x 60 pixels
    """
    from . import _charts
    asked = dict(size=size, view=view, eye=eye, fov=fov, background=background, lights=lights, supersample=supersample)
    rays = dict(depth=depth, shadows=shadows, light_samples=light_samples, occlusion=occlusion,
                occlusion_distance=occlusion_distance, culling=culling)
    given = {name for name, value in {**asked, **rays}.items() if value is not None}
    look = look_of(size or (1024, 1024), view or "iso", eye, at, up, 30.0 if fov is None else fov, parallel, zoom,
                   "white" if background is None else background, supersample or 0)
    look["lights"] = _lights(lights)
    with listening(progress) as listener:
        pixels, report, parameters = _charts.trace_scene(
            os.fsencode(scene), os.fsencode(folder), _parameters.to_json(look),
            _parameters.to_json({name: value for name, value in rays.items() if name in given}), given,
            _parameters.number(turn, "turn"), _parameters.count(threads, "threads"), listener)
    _report.warn(report["warnings"])
    return Picture(pixels, "", (0.0, 1.0), report, parameters)
