# SPDX-License-Identifier: BSD-3-Clause
"""The map that longitude and latitude are put on."""

from typing import NamedTuple

import numpy as np

from . import _core, _parameters


class Map(NamedTuple):
    """A map of positions on the globe: x to the east and y to the north of an origin
    (equirectangular, true to scale at the latitude of the origin).

    Parameters
    ----------
    longitude, latitude : float
        Of the origin, in degrees.
    unit : {"km", "m"}
        Of x and y.

    Examples
    --------
    >>> where = uvol.Map(8.5, -42.5, "km")
    >>> x, y = where.to_map(8.5, [-42.5, -41.5])
    >>> y.round(2).tolist()
    [0.0, 111.2]
    >>> longitude, latitude = where.to_globe(x, y)
    >>> latitude.tolist()
    [-42.5, -41.5]
    """

    longitude: float
    latitude: float
    unit: str = "km"

    def to_map(self, longitude, latitude):
        """Coordinates of positions.

        Parameters
        ----------
        longitude, latitude : array_like
            In degrees.

        Returns
        -------
        x, y : numpy.ndarray

        Examples
        --------
        >>> uvol.Map(179.5, 0.0).to_map(-179.5, 0.0)[0].round(1).item()
        111.2
        """
        return self._transform(_core.to_map, longitude, latitude)

    def to_globe(self, x, y):
        """Longitude (-180 to 180) and latitude of coordinates, in degrees.

        Parameters
        ----------
        x, y : array_like

        Returns
        -------
        longitude, latitude : numpy.ndarray

        Examples
        --------
        >>> [degrees.item() for degrees in uvol.Map(8.5, -42.5).to_globe(0.0, 0.0)]
        [8.5, -42.5]
        """
        return self._transform(_core.to_globe, x, y)

    def _transform(self, function, first, second):
        pairs = np.stack(np.broadcast_arrays(np.asarray(first, float), np.asarray(second, float)), axis=-1)
        found = function(wanted(self), pairs.reshape(-1, 2)).reshape(pairs.shape)
        return found[..., 0], found[..., 1]


def of(dataset):
    """The map of a data set; None without one."""
    if dataset.map is None:
        return None
    longitude, latitude, per_kilometre = dataset.map
    return Map(longitude, latitude, "m" if per_kilometre > 1 else "km")


def wanted(value):
    """What `map` says, for the library: longitude, latitude and coordinates per
    kilometre; NaN and 0 for what the positions shall tell."""
    if value is None:
        return None
    if isinstance(value, str):
        if value != "auto":
            raise ValueError(f"map is {value!r}: it must be 'auto', or longitude and latitude, as in (-71.5, 41, 'km').")
        return float("nan"), float("nan"), 0.0
    parts = list(value) if hasattr(value, "__iter__") else []
    if len(parts) not in (2, 3) or (len(parts) == 3 and parts[2] not in ("m", "km")):
        raise ValueError(f"map is {_parameters.shown(value)}: it must be 'auto', or longitude and latitude, as in "
                         "(-71.5, 41, 'km').")
    longitude, latitude = _parameters.number(parts[0], "map"), _parameters.number(parts[1], "map")
    if not (abs(longitude) <= 360 and abs(latitude) < 90):
        raise ValueError(f"map is {_parameters.shown(value)}: longitudes are from -360 to 360 and latitudes between -90 "
                         "and 90 degrees.")
    return longitude, latitude, {"m": 1000.0, "km": 1.0}[parts[2]] if len(parts) == 3 else 0.0
