# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of surfaces, drawn without a display."""

import os
import tempfile

import numpy as np

from . import _core, _parameters, _report
from ._progress import listening


_OWN_COLORS = ("rgb", "rgba")


class Picture:
    """A picture; a notebook shows it.

    Attributes
    ----------
    pixels : numpy.ndarray of uint8, shape (height, width, 4)
        Red, green, blue and opacity, the first row on top.
    field : str
        What it is coloured by; "" for the colour of the surface.
    range : tuple of float
        The values at the ends of the colours.
    report : dict
        Counts, milliseconds and warnings.
    """

    def __init__(self, pixels, field, limits, report):
        self.pixels = pixels
        self.field = field
        self.range = tuple(limits)
        self.report = report

    def __array__(self, dtype=None):
        return self.pixels if dtype is None else self.pixels.astype(dtype)

    def save(self, path):
        """Write a PNG file, as the tools do."""
        from . import _io
        _io.write_png(os.fspath(path), self.pixels)

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


def _size(size):
    """Width and height."""
    sides = [size, size] if not isinstance(size, (tuple, list)) else list(size)
    if len(sides) != 2:
        raise ValueError(f"size is {size!r}: it must be a number of pixels, or width and height.")
    width, height = (_parameters.count(side, "size") for side in sides)
    return {"width": width, "height": height}


def _place(value):
    return None if value is None else _parameters.numbers(value, "A place or direction")


def look_of(size, view, eye, at, up, fov, zoom, background, supersample):
    """What all pictures are asked for with, scenes as well."""
    look = dict(view=view, eye=_place(eye), at=_place(at), up=_place(up), fov=fov, zoom=zoom, supersample=supersample,
                **_size(size))
    if isinstance(background, str):
        look["background"] = background
    else:
        look["background_color"] = _place(background)
    return look


def _lights(directions):
    """Rows of three numbers."""
    rows = np.asarray([] if directions is None else directions, dtype=object)
    return [_place(row) for row in np.atleast_2d(rows).tolist() if len(row)]


class Drawable:
    """What can be drawn: points with normals."""

    def render(self, *, color="auto", colormap="auto", range=None, log=False, bar=True, size=(1024, 1024), view="iso",
               eye=None, at=None, up=None, fov=30.0, zoom=1.0, background="white", surface_color=None, exaggerate=None,
               lights=None, material=None, supersample=0, culling=False, footprints=True, silhouettes=False,
               features=False, thickness=2, line_color=None, passes=None, threads=0, progress=None):
        """Draw the points in image space (thesis 4.3).

        Parameters
        ----------
        color : str
            A field (of one with several numbers their length) or an expression, "rgb",
            "none", or "auto": rgb if there, else isovalue if there are several.
        colormap : {"auto", "viridis", "cividis", "inferno", "magma", "plasma", "turbo", "gray", "coolwarm", "RdBu", "PuOr", "twilight", "tab10"}
            "auto": tab10 for up to ten whole numbers, else viridis. With "_r" behind the
            name it runs backwards.
        range : pair of float, optional
            Values at the ends of the colours; by default those of the field.
        log : bool
            Colour by the logarithm of the values.
        bar : bool
            Write beside the picture what its colours stand for.
        size : int or pair of int
            Pixels, width and height.
        view : {"iso", "front", "back", "left", "right", "top", "bottom"}
        eye, at, up : array_like, optional
            Place of the camera, instead of a view; place that it looks at; direction
            that is upwards.
        fov : float
            Vertical field of view, degrees.
        zoom : float
            Enlarge the middle of the picture.
        background : {"white", "black", "gradient", "transparent"}, or a colour
            Colours are red, green and blue from 0 to 1.
        surface_color : array_like, optional
            Of points without a colour.
        exaggerate : array_like, optional
            Factors along x, y and z that stretch the picture; `eye` and `at` are places
            in the data.
        lights : array_like, shape (n, 3), optional
            Directions that light comes from: x right, y up, z to the viewer.
        material : dict, optional
            Factors of the light: ambient, diffuse, specular, and shininess, the exponent
            of highlights.
        supersample : int
            Samples per pixel in each direction; 0: 2.
        culling : bool
            Leave out what looks away from the eye.
        footprints : bool
            Points become discs where they lie farther apart than pixels.
        silhouettes, features : bool
            Draw lines, of `line_color`; silhouettes of that thickness, 1 to 7.
        passes : dict, optional
            What few change: fill, occluded, layers, shading, smoothing ("none", "box",
            "gaussian", "alleviated"), smoothings, silhouette_threshold,
            feature_threshold, antialias, antialias_threshold.

        Returns
        -------
        Picture
        """
        look = look_of(size, view, eye, at, up, fov, zoom, background, supersample)
        look.update(self._colors(color, colormap, range, log, surface_color, exaggerate, lights, material),
                    culling=culling, footprints=footprints, silhouettes=silhouettes, features=features,
                    thickness=thickness, line_color=_place(line_color), passes=_parameters.mapping(passes, "passes"))
        return self._draw(_core.render, look, bar, threads, progress)

    def raytrace(self, *, color="auto", colormap="auto", range=None, log=False, bar=True, size=(1024, 1024),
                 view="iso", eye=None, at=None, up=None, fov=30.0, zoom=1.0, background="white", surface_color=None,
                 exaggerate=None, lights=None, material=None, supersample=0, depth=4, shadows=True, light_samples=16,
                 occlusion=0, occlusion_distance=0.0, reflect=0.0, transparent=0.0, index=1.0, splats=None, threads=0,
                 progress=None):
        """Draw the points by ray tracing of splats (thesis 4.2): shadows, mirrors, glass.

        Parameters
        ----------
        depth : int
            Reflections and refractions in a row.
        shadows : bool
        light_samples : int
            Shadow rays to a light that has a radius.
        occlusion : int
            Rays that find how much ambient light reaches a place; 0: all.
        occlusion_distance : float
            What is farther does not count; 0: a fifth of the radius of the scene.
        reflect, transparent : float
            Parts of the light that are mirrored, and let through.
        index : float
            Refractive index of the inside.
        splats : dict, optional
            Parameters of `splats`.

        The others are those of `render`.

        Returns
        -------
        Picture
        """
        look = look_of(size, view, eye, at, up, fov, zoom, background, supersample)
        look.update(self._colors(color, colormap, range, log, surface_color, exaggerate, lights, material))
        rays = dict(depth=depth, shadows=shadows, light_samples=light_samples, occlusion=occlusion,
                    occlusion_distance=occlusion_distance, reflect=reflect, transparent=transparent, index=index,
                    splats=splats)
        return self._draw(_core.raytrace, look, bar, threads, progress, _parameters.to_json(rays))

    def _colors(self, color, colormap, range, log, surface_color, exaggerate, lights, material):
        """What points with fields are asked for with."""
        if not isinstance(color, str):
            raise TypeError(f"color is {color!r}: it must be the name of a field, or an expression.")
        if color in self.keys() and self.records.dtype[color].shape:
            color = f"|{color}|"
        return dict(color=color or "none", colormap=colormap, range=range, log=bool(log), exaggerate=_place(exaggerate),
                    surface_color=_place(surface_color), lights=_lights(lights), material=_parameters.mapping(material, "material"))

    def save_page(self, path, *, color="auto", colormap="auto", range=None, log=False, bar=True, view="iso", eye=None,
                  at=None, up=None, fov=30.0, zoom=1.0, background="white", surface_color=None, exaggerate=None,
                  lights=None, material=None, threads=0, progress=None):
        """Write the points as a web page: one file that turns in any browser, with no
        server and no network, as uvol_render writes it.

        Parameters
        ----------
        path : str or os.PathLike
            Ends in .html.
        color, colormap, range, log, bar, view, eye, at, up, fov, zoom, background, surface_color, exaggerate, lights, material
            As those of `render`.

        Returns
        -------
        dict
            The report.
        """
        from . import _charts
        path = os.fspath(path)
        if not path.endswith(".html"):
            raise ValueError(f"{path!r} is no web page: its name must end in .html.")
        look = look_of(1024, view, eye, at, up, fov, zoom, background, 0)
        look.update(self._colors(color, colormap, range, log, surface_color, exaggerate, lights, material))
        count = _parameters.count(threads, "threads")
        dataset, has_bar = self._find_colors(look, bar, count)
        with listening(progress) as listener:
            report = _charts.write_page(path, dataset, _parameters.to_json(look), has_bar, count, listener)
        _report.tell(report["warnings"])
        return report

    def _find_colors(self, look, bar, threads):
        """The points, with the field that colours them if it is an expression, and
        whether something is to be said of the colours."""
        dataset = self._dataset
        if look["color"] not in ("auto", "none", *_OWN_COLORS):
            dataset = dataset.with_field(look["color"], threads, None)[0]
        return dataset, bool(bar) and _core.color_field(dataset, look["color"]) not in ("", *_OWN_COLORS)

    def _draw(self, function, look, bar, threads, progress, *more):
        """A picture of these points, with what its colours stand for beside it."""
        count = _parameters.count(threads, "threads")
        dataset, has_bar = self._find_colors(look, bar, count)
        if has_bar:
            from . import _charts
            look["margin"] = _charts.bar_width(look["width"], look["height"])
        look = _parameters.to_json(look)
        with listening(progress) as listener:
            pixels, field, limits, report = function(dataset, look, *more, count, listener)
        if has_bar:
            _charts.draw_legend(pixels, dataset, look, limits)
        return finish(pixels, field, limits, report)


def finish(pixels, field, limits, report):
    """A picture, whose warnings are told."""
    picture = Picture(pixels, field, limits, report)
    _report.tell(report["warnings"])
    return picture


def raytrace(scene, *, folder="", size=None, view=None, eye=None, at=None, up=None, fov=30.0, zoom=1.0, background=None,
             supersample=None, threads=0, progress=None):
    """Draw a scene of uvol_raytrace: surfaces of several files with their materials,
    lights and a camera.

    Parameters
    ----------
    scene : str or os.PathLike
        A text file that lists the items of the scene.
    folder : str or os.PathLike
        Where its clouds lie; "": beside it.
    size, view, eye, at, up, fov, zoom, background, supersample
        As those of `Surface.raytrace`, instead of what the scene says; the camera is
        that of the scene unless `view` or `eye` is given.

    Returns
    -------
    Picture
    """
    from . import _io
    asked = dict(size=size, view=view, eye=eye, background=background, supersample=supersample)
    given = {name for name, value in asked.items() if value is not None}
    look = look_of(size or (1024, 1024), view or "iso", eye, at, up, fov, zoom,
                   "white" if background is None else background, supersample or 0)
    with listening(progress) as listener:
        pixels, report = _io.trace_scene(os.fspath(scene), os.fspath(folder), _parameters.to_json(look), given,
                                         _parameters.count(threads, "threads"), listener)
    return finish(pixels, "", (0.0, 1.0), report)
