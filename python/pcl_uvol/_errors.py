# SPDX-License-Identifier: BSD-3-Clause
"""Exceptions and warnings of the module."""


class FieldError(KeyError):
    """There is no field of that name; the message lists those that there are."""

    def __str__(self):
        return self.args[0] if self.args else ""


class DivergedError(ArithmeticError):
    """An iteration grew beyond bounds: nothing came of it."""


class ResultWarning(UserWarning):
    """What should be known of a result although the call succeeded."""
