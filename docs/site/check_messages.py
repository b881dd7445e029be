#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Lists every message that the documentation quotes but no program prints. Quotations are in double quotes, at the begin
of a table row or of bold text. Names in single quotes, numbers and "..." match any value.

usage: check_messages.py REPOSITORY PAGE...
"""
import pathlib
import re
import sys

LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
QUOTED = re.compile(r'^(?:\| |\*\*)"(.+?)"(?: \||\*\*)', re.MULTILINE)
VARIES = re.compile(r"\.\.\.|'[^']*'|\[[^]]*\]|-?\d[\d.e+-]*")
SHORTEST = 8  # characters of a part that identifies a message


def read_printed(root):
    """All texts of the sources, parts of one sentence joined, options as the tools write them."""
    texts = []
    for folder in ("src", "include", "tools", "python"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".cpp", ".h", ".py"):
                texts.append(re.sub(r'"\s*\n\s*"', "", path.read_text()))
    return re.sub(r"\{(-[^{}]*)\}", r"\1", "\n".join(match for text in texts for match in LITERAL.findall(text)))


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    printed = read_printed(pathlib.Path(sys.argv[1]))
    unknown = []
    for page in map(pathlib.Path, sys.argv[2:]):
        sentences = QUOTED.findall(page.read_text())
        if not sentences:
            unknown.append(f"{page} quotes no message.")
        for sentence in sentences:
            parts = [part.strip(" .,:;()?") for part in VARIES.split(sentence)]
            parts = [part for part in parts if len(part) >= SHORTEST]
            unknown += [f"{page}: nothing prints '{part}'." for part in parts if part not in printed]
            if not parts:
                unknown.append(f"{page}: '{sentence}' is too short to search for.")
    sys.exit("\n".join(unknown) or 0)


if __name__ == "__main__":
    main()
