#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Names what Doxygen warns of, but for what the text of a function says already: what a function returns, and the one
parameter of a setter (setX(x), SetX of VTK), which is what its text is about. Variables, types and values without a
text are allowed where their name says all; every function has a text, and all its parameters documented.

usage: check_api.py DOXYGEN_WARNINGS
"""
import pathlib
import re
import sys

ALLOWED = re.compile(r"warning: (?:Member .* \((?!function)\w+\) of .* is not documented\.$|return type of member "
                     r"|parameters of member \S*(?:< \w+ >)?::[sS]et[A-Z]\w* are not documented)")
# Doxygen 1.9.4 warns so of size(), which has none.
WITHOUT = re.compile(r"parameters of member \S+::size are not documented")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    lines = pathlib.Path(sys.argv[1]).read_text().splitlines()
    found, is_shown = [], False
    for line in lines:
        if "warning:" in line:
            is_shown = not ALLOWED.search(line) and not WITHOUT.search(line)
        if is_shown:
            found.append(line)
    sys.exit("\n".join(found) or 0)


if __name__ == "__main__":
    main()
