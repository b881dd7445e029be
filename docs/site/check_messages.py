#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Names every sentence that the documentation quotes in double quotes, at the begin of a row or of a bold line, and
that no program prints. Names in single quotes, numbers and "..." stand for whatever a program puts there.

usage: check_messages.py REPOSITORY PAGE...
"""
import pathlib
import re
import sys

LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
QUOTED = re.compile(r'^(?:\| |\*\*)"(.+?)"(?: \||\*\*)', re.MULTILINE)
VARIES = re.compile(r"\.\.\.|'[^']*'|\[[^]]*\]|-?\d[\d.e+-]*")
SHORTEST = 8  # of a part that tells one sentence from another


def read_printed(root):
    """All texts of the sources, parts of one sentence joined."""
    texts = []
    for folder in ("src", "include", "tools", "python"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".cpp", ".h", ".py"):
                texts.append(re.sub(r'"\s*\n\s*"', "", path.read_text()))
    return "\n".join(match for text in texts for match in LITERAL.findall(text))


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    printed = read_printed(pathlib.Path(sys.argv[1]))
    unknown = []
    for page in map(pathlib.Path, sys.argv[2:]):
        sentences = QUOTED.findall(page.read_text())
        if not sentences:
            unknown.append(f"{page} quotes nothing.")
        for sentence in sentences:
            parts = [part.strip(" .,:;()?") for part in VARIES.split(sentence)]
            parts = [part for part in parts if len(part) >= SHORTEST]
            unknown += [f"{page}: nothing prints '{part}'." for part in parts if part not in printed]
            if not parts:
                unknown.append(f"{page}: too little is left of '{sentence}' to look for.")
    sys.exit("\n".join(unknown) or 0)


if __name__ == "__main__":
    main()
