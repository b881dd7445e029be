# SPDX-License-Identifier: BSD-3-Clause
"""The warnings of a run as those of Python."""

import os
import sys
import warnings

from ._errors import ResultWarning

_FOLDER = os.path.dirname(__file__)


def warn(messages):
    """Warn of each, at the line of the user's that called the module."""
    if not messages:
        return
    level = 1
    frame = sys._getframe(0)
    while frame is not None and os.path.dirname(frame.f_code.co_filename) == _FOLDER:
        frame = frame.f_back
        level += 1
    for message in messages:
        warnings.warn(ResultWarning(message["text"], message["code"], message["values"]), stacklevel=level)
