# SPDX-License-Identifier: BSD-3-Clause
"""Keywords of functions that are the parameters of a stage, with what the library says of these, and what the docstrings
of many functions say alike."""

import functools
import inspect
import json
import textwrap

# Entries that stand in the place of a line {name} of a docstring.
SHARED = {
    "points, fields": """\
points : array_like, shape (n, 3), or Samples
    Coordinates, float32 or float64; or samples, which bring their fields.
fields : mapping of str to array_like, optional
    Values at the points, shape (n,) or (n, k); NaN is a missing value. See `Samples`.""",
    "field": """\
field : str
    The scalar: a field's name, `vel[1]`, `|vel|`, or an expression as `log10(rho)`.
    By default `intensity`, else the only candidate.""",
    "scale, rotate": """\
scale : sequence of three float, matrix of 3 rows, "auto" or "spacing", optional
    Factors per axis of the space that distances are measured in, or the map to it;
    "auto": as the field changes along each axis, or, where there is no field, as
    "spacing": as far apart as samples lie along each. By default 1.
rotate : sequence of three float, optional
    Strike, dip and plunge in degrees of the axes of the scale: x is east, y north.
    The second axis is a line that plunges in a plane that dips, the third one the
    plane's normal.""",
    "periodic": """\
periodic : sequence of 3 floats, or "header", optional
    Sides of the box that the samples repeat in, 0 along an axis for none, or those
    that the file names (`Samples.box`): neighbours are seen across its faces. It goes
    without `rotate`.""",
    "threads, progress": """\
threads : int
    0: all cores. The result does not depend on it.
progress : bool or callable, optional
    True: a bar; else called as progress(step, done) with the share done in [0, 1].""",
}


def described(description="[]"):
    """Let a function that takes **parameters take those of a stage by name: in its signature before `threads`, and in
    its docstring in the place of a line {parameters}. Those that it takes itself, by their names or as options of tools
    are called, are left to it.

    description : str
        JSON of names, options, types, defaults and help.
    """

    def decorate(function):
        signature = inspect.signature(function)
        listed = [parameter for parameter in signature.parameters.values() if parameter.kind != parameter.VAR_KEYWORD]
        members = [member for member in json.loads(description)
                   if not {member["name"], member["option"]} & set(signature.parameters)]
        place = next(i for i, parameter in enumerate(listed) if parameter.name == "threads")
        listed[place:place] = [inspect.Parameter(member["name"], inspect.Parameter.KEYWORD_ONLY, default=member["default"])
                               for member in members]

        @functools.wraps(function)
        def call(*values, **options):
            return function(*values, **options)

        call.__signature__ = signature.replace(parameters=listed)
        call.__doc__ = fill(function.__doc__, members)
        return call

    return decorate


def fill(text, members):
    """A docstring with an entry for each member, and those that are shared; that of Python -OO stays None."""
    if text is None:
        return None
    entries = []
    for member in members:
        help = member["help"][0].upper() + member["help"][1:] + "."
        entries += [f"{member['name']} : {member['type']}",
                    *textwrap.wrap(help, 88, initial_indent=" " * 4, subsequent_indent=" " * 4)]
    filled = inspect.cleandoc(text)
    for name, entry in {**SHARED, "parameters": "\n".join(entries)}.items():
        filled = filled.replace("{" + name + "}", entry)
    return filled
