# SPDX-License-Identifier: BSD-3-Clause
"""Progress as a bar, or as whatever the user's function makes of it."""

import sys

from . import _parameters


class Bar:
    """Shows step and share on the last line of the terminal, or by tqdm if it is there."""

    def __init__(self):
        self._tqdm = None
        self._step = None
        try:
            from tqdm.auto import tqdm
            self._tqdm = tqdm
        except ImportError:
            pass
        self._bar = None

    def __call__(self, step, done):
        if self._tqdm is None:
            sys.stderr.write(f"\r{step.replace('_', ' '):<24} {100 * done:3.0f} %")
            sys.stderr.flush()
            return
        if step != self._step:
            self.close()
            self._bar = self._tqdm(total=100, desc=step.replace("_", " "), leave=False,
                                   bar_format="{desc}: {percentage:3.0f} %|{bar}|")
        self._step = step
        self._bar.n = round(100 * done)
        self._bar.refresh()

    def close(self):
        """Remove what was shown."""
        if self._bar is not None:
            self._bar.close()
            self._bar = None
        elif self._tqdm is None:
            sys.stderr.write("\r" + " " * 32 + "\r")


class listening:
    """With-block that gives the extension the function to call: None, the user's, or a
    bar's for True."""

    def __init__(self, progress):
        if progress is True:
            self._listener = Bar()
        elif progress is None or progress is False:
            self._listener = None
        elif callable(progress):
            self._listener = progress
        else:
            raise TypeError(f"progress is True or a function of a step's name and the share that is done, "
                            f"not {_parameters.shown(progress)}.")

    def __enter__(self):
        return self._listener

    def __exit__(self, *unused):
        if isinstance(self._listener, Bar):
            self._listener.close()
