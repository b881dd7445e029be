# SPDX-License-Identifier: BSD-3-Clause
"""Exceptions and warnings of the module."""


class FieldError(KeyError):
    """There is no field of that name; the message lists those that there are.

    Attributes
    ----------
    code : str or None
        What went wrong, as one word; None if there is only a text.
    values : dict
        The numbers and names in the text.

    Examples
    --------
    >>> try:
    ...     uvol.Samples(np.eye(3), {"density": [1.0, 2.0, 3.0]})["densty"]
    ... except uvol.FieldError as error:  # a KeyError
    ...     print(error)
    There is no field 'densty' (did you mean 'density'?); the fields are density.
    """

    code = None
    values = {}

    def __str__(self):
        return self.args[0] if self.args else ""


class DivergedError(ArithmeticError):
    """An iteration grew beyond bounds: nothing came of it.

    Attributes
    ----------
    code : str or None
        What went wrong, as one word; None if there is only a text.
    values : dict
        The numbers and names in the text.

    Examples
    --------
    >>> issubclass(uvol.DivergedError, ArithmeticError)
    True
    """

    code = None
    values = {}


class ResultWarning(UserWarning):
    """What should be known of a result although the call succeeded; `report["warnings"]`
    of the result lists it as well, as {"code": ..., "text": ..., "values": ...}.

    Attributes
    ----------
    code : str
        Kind of warning, as one word that stays when the text changes.
    values : dict
        The numbers and names in the text.

    Examples
    --------
    >>> import warnings
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     surface = uvol.isosurface(np.eye(3), {"r": [1.0, 2.0, 3.0]}, iso=7.0)
    >>> caught[0].category.__name__, len(surface), len(surface.report["warnings"]) > 0
    ('ResultWarning', 0, True)
    >>> warning = caught[0].message
    >>> surface.report["warnings"][0] == {"code": warning.code, "text": str(warning), "values": warning.values}
    True
    """

    def __init__(self, text="", code="text", values=None):
        super().__init__(text)
        self.code = code
        self.values = {} if values is None else values
