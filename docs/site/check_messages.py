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


def check_parameters(root):
    """The parameters that messages name exist where they are named: see src/common/message.cpp."""
    source = (root / "src/common/message.cpp").read_text()
    listed = {name: set(re.findall(r'"-([a-z-]+)"', re.search(name + r"\[\] = \{(.*?)\}", source, re.DOTALL).group(1)))
              for name in ("tools_only", "with_property")}
    tables = "".join((root / "src/common" / f"{kind}_texts.cpp").read_text() for kind in ("warning", "error", "file_error"))
    named = set(re.findall(r"\{-([a-z-]+)", tables))
    python = set(re.findall(r"(\w+): ", (root / "python/pcl_uvol/__init__.pyi").read_text())) | {"viewpoint"}
    vtk = set(re.findall(r"vtk[GS]et\w*Macro\((\w+)|[GS]et(\w+)\(", "".join(
        path.read_text() for path in (root / "include/pcl_uvol/filters").glob("*.h"))))
    properties = {word for words in vtk for word in words}
    wrong = [f"Python has no parameter for -{name}." for name in sorted(named - listed["tools_only"])
             if name.replace("-", "_") not in python]
    for name in sorted(named):
        in_vtk = "".join("Maximum" if word == "max" else word.capitalize() for word in name.split("-")) in properties
        if in_vtk != (name in listed["with_property"]):
            wrong.append(f"-{name} is {'a' if in_vtk else 'no'} property of VTK's filters.")
    return wrong


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    printed = read_printed(pathlib.Path(sys.argv[1]))
    unknown = check_parameters(pathlib.Path(sys.argv[1]))
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
