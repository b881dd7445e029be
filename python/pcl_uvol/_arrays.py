# SPDX-License-Identifier: BSD-3-Clause
"""From what users have, arrays of any kind, to the records of a dataset."""

import numpy as np

from . import _core, _parameters

_LETTERS = {"b": "?", "i": "i", "u": "u", "f": "f"}
_LARGEST_SIZE = 8


def as_labels(values):
    """Numbers of names and the names, in alphabetical order, of a column of texts: strings
    of numpy, objects, pandas' texts and categories; None for other columns. An empty text
    and None are no name, -1."""
    try:
        array = values if hasattr(values, "dtype") else np.asarray(values)
    except ValueError:  # rows of different lengths, which as_array tells of
        return None
    if array.dtype.kind not in "OU" or np.ndim(array) != 1:
        return None
    if np.ma.isMaskedArray(array):
        array = array.filled("")
    texts = ["" if _is_missing(value) else value for value in np.asarray(array, dtype=object)]
    if not any(texts) or not all(isinstance(value, str) for value in texts):
        return None
    names = [_parameters.text(name, "A name") for name in sorted(set(texts) - {""})]
    numbers = {"": -1, **{name: number for number, name in enumerate(names)}}
    return np.array([numbers[text] for text in texts], np.int32), names


def _is_missing(value):
    is_nan = isinstance(value, float) and value != value
    return value is None or is_nan or type(value).__name__ == "NAType"  # of pandas


def as_array(values, what):
    """The values as a numpy array of numbers; missing ones of masked arrays and of
    pandas become NaN."""
    if hasattr(values, "to_numpy") and not isinstance(values, np.ndarray):
        values = _from_pandas(values)
    try:
        array = np.ma.asarray(values) if np.ma.isMaskedArray(values) else np.asarray(values)
    except ValueError as error:
        raise ValueError(f"{what} is not an array of numbers: its rows have different lengths.") from error
    if array.ndim == 0 and array.dtype.kind in "OSU":
        raise ValueError(f"{what} is {_parameters.shown(values)}: it must be an array of numbers.")
    if array.dtype.kind == "O":
        raise ValueError(f"{what} holds Python objects, not numbers: convert it first, say by .astype(float).")
    if array.dtype.kind in "mM":
        raise ValueError(f"{what} holds times: it must hold numbers, say (t - t.min()) / numpy.timedelta64(1, 's').")
    if array.dtype.kind not in _LETTERS:
        raise ValueError(f"{what} has the type {array.dtype}: it must hold numbers or booleans.")
    if np.ma.isMaskedArray(array):
        if array.mask.any():
            array = array.astype(array.dtype if array.dtype.kind == "f" else np.float64)
        return array.filled(np.nan) if array.mask.any() else array.data
    return array


def _from_pandas(values):
    """A column, array or table of pandas: missing values of the number types of pandas are NaN."""
    dtypes = getattr(values, "dtypes", getattr(values, "dtype", None))
    kinds = list(dtypes) if hasattr(dtypes, "__iter__") else [dtypes]
    if any(hasattr(kind, "numpy_dtype") for kind in kinds):
        try:
            if len(set(kinds)) > 1 or np.any(values.isna()):
                return values.to_numpy(dtype=np.float64, na_value=np.nan)
            return values.to_numpy(dtype=kinds[0].numpy_dtype)
        except (TypeError, ValueError):
            pass  # texts and the like, which are refused by their type
    return values.to_numpy()


def _number_type(dtype):
    """Numpy's name of the type that a field gets: wider for float16, in double for
    longer ones."""
    size = dtype.itemsize
    if dtype.kind == "f":
        size = 4 if size <= 4 else _LARGEST_SIZE
    return "?" if dtype.kind == "b" else f"{_LETTERS[dtype.kind]}{size}"


def coordinates(points):
    """Points as an array of shape (n, 3); columns of zeros are not made up."""
    array = as_array(points, "points")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"points has the shape {array.shape}: it must be (n, 3), a row for each point.")
    return array


def stack_axes(table, axes, what):
    """Columns of a table, or fields of a structured array, as coordinates."""
    columns = [as_array(table[axis], f"The {what} {axis!r}") for axis in axes]
    for axis, column in zip(axes, columns):
        if column.ndim != 1:
            raise ValueError(f"The {what} {axis!r} has the shape {column.shape}: it must be (n,), a number for each point.")
    return np.stack(columns, axis=1)


def as_triangles(values, count):
    """Rows of three indices of so many vertices."""
    array = as_array(values, "triangles")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"triangles has the shape {array.shape}: it must be (m, 3), a row for each triangle.")
    if array.dtype.kind not in "iu" and len(array):
        raise ValueError(f"triangles has the type {array.dtype}: it must hold whole numbers, indices of vertices.")
    if len(array) and not 0 <= array.min() <= array.max() < count:
        raise ValueError(f"triangles has the indices {array.min()} to {array.max()}: there are {count} vertices.")
    return np.ascontiguousarray(array, np.uint32)


@_parameters.with_proposals
def empty(count, fields=None):
    """Records in the library's memory, to be filled in: `Samples` takes them without a
    copy.

    Arrays of any other memory are copied once, since clouds of PCL own their bytes.

    Parameters
    ----------
    count : int
        Points.
    fields : mapping of str to dtype, optional
        Types of the fields: "f4", or ("f4", 3) for three numbers per point.

    Returns
    -------
    numpy.ndarray, shape (count,)
        A structured array of x, y, z in float32 and the fields, all zero. It can be
        written to until it is given to `Samples`.

    Examples
    --------
    >>> records = uvol.empty(1000, {"rho": "f8", "vel": ("f4", 3)})
    >>> records["x"] = np.linspace(0, 1, 1000)
    >>> records["vel"] = 1.0
    >>> samples = uvol.Samples(records)
    >>> np.shares_memory(samples["rho"], records)
    True
    """
    count = _parameters.count(count, "count")
    types = {name: np.dtype(kind) for name, kind in _parameters.mapping(fields, "fields", "types").items()}
    specs = [(axis, "f4", 1) for axis in "xyz"]
    for name, kind in types.items():
        _check_name(name)
        if kind.base.kind not in _LETTERS or len(kind.shape) > 1 or 0 in kind.shape:
            raise ValueError(f"The field {name!r} has the type {kind}: it must hold numbers or booleans, one or "
                             "several per point.")
        specs.append((name, _number_type(kind.base), kind.shape[0] if kind.shape else 1))
    dataset = _core.Dataset.allocate(specs, count)
    return view_records(dataset, dataset.bytes)


def take_over(records):
    """The dataset whose memory records of empty() are, which can no longer be written
    to; None for other arrays, for parts of such records, and with a mask, which the memory
    has not."""
    owner = None if np.ma.isMaskedArray(records) else records
    while isinstance(owner, np.ndarray):
        owner = owner.base
    if not isinstance(owner, _core.Dataset) or not records.flags.writeable or len(records) != owner.count:
        return None
    if len(records) and (records.ctypes.data, records.strides[0]) != (owner.bytes.ctypes.data, owner.bytes.strides[0]):
        return None
    if records.dtype.names != tuple(name for name, *_ in owner.fields):
        return None
    records.flags.writeable = False  # the records are points already, with an origin of 0
    return owner


def _check_name(name):
    if not isinstance(name, str) or not name:
        raise ValueError(f"A field is called {_parameters.shown(name)}: names are texts of at least a letter.")
    _parameters.text(name, "The name of a field")
    if name in ("x", "y", "z"):
        raise ValueError(f"The field {name!r} is a coordinate: it belongs to the points.")
    if name == "_":
        raise ValueError("The field '_' has the name of padding, which holds nothing: call it otherwise.")


def make_dataset(points, fields):
    """A dataset from coordinates and a mapping of names to columns."""
    xyz = coordinates(points)
    count = len(xyz)
    columns, labels = {}, {}
    for name, values in _parameters.mapping(fields, "fields", "columns").items():
        _check_name(name)
        texts = as_labels(values)
        if texts is not None:
            values, labels[name] = texts
        columns[name] = _column(name, values, count)
    axis_type = _number_type(xyz.dtype)
    specs = [(axis, axis_type, 1) for axis in "xyz"]
    specs += [(name, _number_type(column.dtype), column.shape[1] if column.ndim == 2 else 1)
              for name, column in columns.items()]
    dataset = _core.Dataset.allocate(specs, count)
    data = dataset.bytes
    records = view_records(dataset, data)
    for axis, name in enumerate("xyz"):
        records[name] = xyz[:, axis]
    for name, column in columns.items():
        records[name] = column if column.ndim == 1 or column.shape[1] > 1 else column[:, 0]
    for name, names in labels.items():
        dataset.set_labels(name, names)
    dataset.settle()
    return dataset


def _column(name, values, count):
    column = as_array(values, f"The field {name!r}")
    if column.ndim not in (1, 2) or (column.ndim == 2 and column.shape[1] == 0):
        raise ValueError(f"The field {name!r} has the shape {column.shape}: it must be (n,), or (n, k) for "
                         "k numbers per point.")
    if len(column) != count:
        raise ValueError(f"The field {name!r} has {len(column)} values for {count} points.")
    return column


def view_records(dataset, data=None):
    """The points of a dataset as a structured array: no copy."""
    data = dataset.bytes if data is None else data
    names, formats, offsets = [], [], []
    for name, kind, components, offset in dataset.fields:
        names.append(name)
        formats.append(kind if components == 1 else (kind, (components,)))
        offsets.append(offset)
    dtype = np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": data.shape[1]})
    return np.ndarray(len(data), dtype, data)


def view_axes(records, names, dtype=np.float32):
    """Three neighbouring numbers of each record as an array of shape (n, 3): no copy."""
    if len(records) == 0:
        return np.empty((0, 3), dtype)
    first = records.dtype.fields[names[0]][1]
    size = np.dtype(dtype).itemsize
    for place, name in enumerate(names):
        if records.dtype.fields[name] != (np.dtype(dtype), first + place * size):
            return None
    return np.ndarray((len(records), 3), dtype, records, first, (records.strides[0], size))
