# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of surfaces, drawn without a display."""

import os
import tempfile

from . import _core, _parameters, _report
from ._progress import listening


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


def _look(color, colormap, range, size, view, eye, at, up, fov, zoom, background, surface_color, supersample):
    """What all pictures are asked for with."""
    look = dict(color=color, colormap=colormap, range=range, view=view, eye=_place(eye), at=_place(at), up=_place(up),
                fov=fov, zoom=zoom, surface_color=_place(surface_color), supersample=supersample, **_size(size))
    if isinstance(background, str):
        look["background"] = background
    else:
        look["background_color"] = _place(background)
    return look


class Drawable:
    """What can be drawn: points with normals."""

    def render(self, *, color="auto", colormap="viridis", range=None, size=(1024, 1024), view="iso", eye=None, at=None,
               up=None, fov=30.0, zoom=1.0, background="white", surface_color=None, supersample=0, culling=False,
               footprints=True, silhouettes=False, features=False, thickness=2, line_color=None, threads=0,
               progress=None):
        """Draw the points in image space (thesis 4.3).

        Parameters
        ----------
        color : str
            A field or an expression, "rgb", "none", or "auto": rgb if there, else
            isovalue if there are several.
        colormap : {"viridis", "cividis", "inferno", "magma", "plasma", "turbo", "gray", "coolwarm", "RdBu", "PuOr", "twilight", "tab10"}
        range : pair of float, optional
            Values at the ends of the colours; by default those of the field.
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
        supersample : int
            Samples per pixel in each direction; 0: 2.
        culling : bool
            Leave out what looks away from the eye.
        footprints : bool
            Points become discs where they lie farther apart than pixels.
        silhouettes, features : bool
            Draw lines, of `line_color`; silhouettes of that thickness, 1 to 7.

        Returns
        -------
        Picture
        """
        look = _look(color, colormap, range, size, view, eye, at, up, fov, zoom, background, surface_color, supersample)
        look.update(culling=culling, footprints=footprints, silhouettes=silhouettes, features=features,
                    thickness=thickness, line_color=_place(line_color))
        dataset = self._colored(color, threads)
        with listening(progress) as listener:
            drawn = _core.render(dataset, _parameters.to_json(look), _parameters.count(threads, "threads"), listener)
        return _finish(drawn)

    def raytrace(self, *, color="auto", colormap="viridis", range=None, size=(1024, 1024), view="iso", eye=None,
                 at=None, up=None, fov=30.0, zoom=1.0, background="white", surface_color=None, supersample=0, depth=4,
                 shadows=True, light_samples=16, occlusion=0, occlusion_distance=0.0, reflect=0.0, transparent=0.0,
                 index=1.0, splats=None, threads=0, progress=None):
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
        look = _look(color, colormap, range, size, view, eye, at, up, fov, zoom, background, surface_color, supersample)
        rays = dict(depth=depth, shadows=shadows, light_samples=light_samples, occlusion=occlusion,
                    occlusion_distance=occlusion_distance, reflect=reflect, transparent=transparent, index=index,
                    splats=splats)
        dataset = self._colored(color, threads)
        with listening(progress) as listener:
            drawn = _core.raytrace(dataset, _parameters.to_json(look), _parameters.to_json(rays),
                                   _parameters.count(threads, "threads"), listener)
        return _finish(drawn)

    def _colored(self, color, threads):
        """The dataset with the field that it is coloured by."""
        if not isinstance(color, str):
            raise TypeError(f"color is {color!r}: it must be the name of a field, or an expression.")
        if color in ("auto", "none", "rgb", "rgba", ""):
            return self._dataset
        return self._dataset.with_field(color, _parameters.count(threads, "threads"), None)[0]


def _finish(drawn):
    picture = Picture(*drawn)
    _report.tell(picture.report["warnings"])
    return picture
