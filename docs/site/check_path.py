#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Check the call path to the first isopoint in docs/how/index.md: each function is in its file and calls the next.

Usage: check_path.py REPOSITORY
"""
import pathlib
import re
import sys

LIMIT = 45  # a path that one can read in one go


def main():
    root = pathlib.Path(sys.argv[1])
    page = root / "docs/how/index.md"
    stops = re.findall(r"^\d+\. \[`(\w+)`\]\(([^)]+)\)", page.read_text(), re.M)
    texts = [(page.parent / path).read_text() for _, path in stops]
    faults = [f"{stops[i][1]} has no {name}()" for i, (name, _) in enumerate(stops)
              if not re.search(rf"\b{name}\(", texts[i])]
    faults += [f"{stops[i][0]} of {stops[i][1]} does not call {name}()" for i, (name, _) in enumerate(stops[1:])
               if not re.search(rf"\b{name}\b", texts[i] + texts[max(i - 1, 0)])]  # or in the lambda that it gets
    if not 0 < len(stops) < LIMIT:
        faults.append(f"{len(stops)} functions, the limit is {LIMIT}")
    print("\n".join(faults) or f"{len(stops)} functions to the first isopoint")
    sys.exit(1 if faults else 0)


main()
