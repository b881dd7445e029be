# SPDX-License-Identifier: BSD-3-Clause
"""Exceptions and warnings of the module."""


class FieldError(KeyError):
    """There is no field of that name; the message lists those that there are.

    Examples
    --------
    >>> try:
    ...     uvol.Samples(np.eye(3), {"density": [1.0, 2.0, 3.0]})["desnity"]
    ... except uvol.FieldError as error:  # a KeyError
    ...     print(error)
    There is no field 'desnity' (did you mean 'density'?); the fields are density.
    """

    def __str__(self):
        return self.args[0] if self.args else ""


class DivergedError(ArithmeticError):
    """An iteration grew beyond bounds: nothing came of it.

    Examples
    --------
    >>> issubclass(uvol.DivergedError, ArithmeticError)
    True
    """


class ResultWarning(UserWarning):
    """What should be known of a result although the call succeeded; `report["warnings"]`
    of the result lists it as well.

    Examples
    --------
    >>> import warnings
    >>> with warnings.catch_warnings(record=True) as told:
    ...     warnings.simplefilter("always")
    ...     surface = uvol.isosurface(np.eye(3), {"r": [1.0, 2.0, 3.0]}, iso=7.0)
    >>> told[0].category.__name__, len(surface), len(surface.report["warnings"]) > 0
    ('ResultWarning', 0, True)
    """
