# SPDX-License-Identifier: BSD-3-Clause
"""From keyword arguments to the JSON that the library's parameters are read from."""

import functools
import inspect
import json
import math
import operator
import re
import reprlib
from collections.abc import Iterable, Mapping

import numpy as np

from . import _core


def shown(value):
    """What a sentence says of a value of any kind: not much, in one line."""
    return " ".join(reprlib.repr(value).split())


def several(value):
    """The items of a list, a tuple or an array with an axis; else None."""
    is_list = isinstance(value, (list, tuple, range)) or getattr(value, "ndim", 0) > 0
    return list(value) if is_list else None


def plain(value, what="A parameter"):
    """The value as Python's own numbers, texts, lists and dictionaries."""
    if isinstance(value, dict):
        return {text(str(key), "A parameter"): plain(item, str(key)) for key, item in value.items()}
    if isinstance(value, np.ndarray) or hasattr(value, "tolist"):
        return plain(value.tolist(), what)
    if isinstance(value, (list, tuple, range, set, frozenset)):
        return [plain(item, what) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        raise ValueError(f"{what} is {shown(value)}: it must be a finite number.")
    if isinstance(value, str):
        return text(value, what)
    if isinstance(value, (bool, int, float)) or value is None:
        return value
    raise ValueError(f"{what} is {shown(value)}: the parameter must be a number, a text, or a list of these.")


def to_json(parameters):
    """The JSON of a dictionary of parameters."""
    return json.dumps(plain(parameters))


def numbers(values, what, dimensions=1):
    """One number or several as a list of finite ones, of rows one after the other."""
    try:
        array = np.ma.asarray(values)
    except ValueError:  # rows of different lengths
        array = np.ma.array([])
    if (array.dtype.kind not in "iufb" or array.ndim > dimensions or array.size == 0 or np.ma.is_masked(array)
            or not np.isfinite(array.data).all()):
        raise ValueError(f"{what} is {shown(values)}: it must be a finite number, or several.")
    return [float(value) for value in array.data.ravel()]


def number(value, what):
    """One finite number."""
    found = numbers(value, what)
    if len(found) != 1:
        raise ValueError(f"{what} is {shown(value)}: it must be one number.")
    return found[0]


def flag(value, what):
    """True or False, of Python or numpy."""
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{what} is {shown(value)}: it must be True or False.")
    return bool(value)


def text(value, what):
    """A text that the library can be given, in UTF-8."""
    if not isinstance(value, str):
        raise TypeError(f"{what} is {shown(value)}: it must be a text.")
    try:
        value.encode()
    except UnicodeEncodeError:
        raise ValueError(f"{what} is {shown(value)}: it contains halves of characters, which are not text.") from None
    return value


def propose(names, name):
    """What is said of the name that was meant, if one is similar."""
    similar = _core.find_similar(names, name.encode(errors="replace").decode())
    return f" (did you mean {similar!r}?)" if similar else ""


def check_keywords(name, known, options):
    """Refuse an unknown keyword, and name the one that was meant."""
    for option in options:
        if option not in known:
            raise TypeError(f"{name}() has no keyword {option!r}{propose(known, option)}.")


def with_proposals(function):
    """The function, which names the keyword that was meant for an unknown one."""
    @functools.wraps(function)
    def call(*values, **options):
        known, needed = keywords_of(call)
        check_keywords(name, known, options)
        for keyword in needed:
            if keyword not in options:
                raise TypeError(f"{name}() needs the keyword {keyword!r}.")
        return function(*values, **options)

    name = re.sub(r"\.__(init|call)__$", "", function.__qualname__).rpartition(".")[2]
    return call


@functools.cache
def keywords_of(function):
    """Names of all parameters, and of those that must be given by name."""
    parameters = [parameter for parameter in inspect.signature(function).parameters.values()
                  if parameter.name not in ("self", "cls") and parameter.kind != parameter.VAR_KEYWORD]
    needed = [parameter.name for parameter in parameters
              if parameter.kind == parameter.KEYWORD_ONLY and parameter.default is parameter.empty]
    return [parameter.name for parameter in parameters], needed


def names(values, what, of):
    """Several texts."""
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise TypeError(f"{what} is {shown(values)}: it must be a sequence of {of}.")
    return [text(value, f"An item of {what}") for value in values]


def mapping(value, what, of="parameters"):
    """A dictionary; an empty one for None."""
    if value is None:
        return {}
    if not isinstance(value, Mapping) and not hasattr(value, "keys"):
        raise TypeError(f"{what} is {shown(value)}: it must be a dictionary, of names to {of}.")
    return {name: value[name] for name in value.keys()}


class Stretch:
    """The space that distances are measured in: factors along axes, and the angles of these; or the word of the
    choice of factors."""

    def __init__(self, scale, rotate=None):
        self.word = scale if isinstance(scale, str) else None
        self.factors = None
        self.rotation = [0.0, 0.0, 0.0] if rotate is None else numbers(rotate, "rotate")
        if len(self.rotation) != 3:
            raise ValueError(f"rotate has {len(self.rotation)} angles: there must be three: strike, dip and plunge.")
        if self.word is not None:
            if self.word not in ("auto", "spacing"):
                raise ValueError(f"scale is {scale!r}: it must be three factors, a matrix, 'auto' or 'spacing'.")
            return
        self.factors = numbers(scale, "scale", dimensions=2)
        if len(self.factors) == 9 and rotate is None:
            self.factors, self.rotation = _core.split_map(self.factors)
        elif len(self.factors) != 3:
            raise ValueError(f"scale has {len(self.factors)} factors: there must be three, one for each axis, or the "
                             "nine numbers of a matrix, without rotate.")

    def resolve(self, dataset, field=None, threads=0):
        """The factors for samples; "auto" finds them from a field, and without one from the spacing."""
        if self.word == "auto" and field is not None:
            return _core.scale_of_field(dataset, field, self.rotation, threads)
        if self.word is not None:
            return _core.equalizing_scale(dataset, self.rotation)
        return self.factors


def count(value, what):
    """A whole number from 0."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{what} is {shown(value)}: it must be a whole number from 0.") from None
    if not 0 <= number < 2**31:
        raise ValueError(f"{what} is {shown(value)}: it must be a whole number from 0.")
    return number


class Parameters(dict):
    """Parameters of a stage by the library's names, with the defaults of those that were not given; None is for the
    choice of the stage. Printed it has a line for each."""

    def __str__(self):
        return "\n".join(self._lines(""))

    def _lines(self, prefix):
        for name, value in self.items():
            if isinstance(value, dict):
                yield from Parameters(value)._lines(f"{prefix}{name}.")
            else:
                yield f"{prefix}{name} = {value!r}"


def from_json(text):
    """The library's parameters; what is not given is None."""
    return Parameters(json.loads(text))


def take(report):
    """The parameters that the library took, which come with its report, and leave it."""
    return from_json(report.pop("parameters"))
