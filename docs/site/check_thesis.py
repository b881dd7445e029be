#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks docs/thesis.md: every numbered section, definition, equation, table and figure of the thesis is on it, and every
file, test and program that it names exists.

usage: check_thesis.py REPOSITORY
"""
import pathlib
import re
import sys

# Largest number of each kind per chapter. Definitions, examples, lemmas and propositions are counted together.
NUMBERED = {
    "Section": {2: 6, 3: 5, 4: 3},  # the last ones, 2.5, 3.6 and 4.4, are the results in the tables
    "Subsection": {2.2: 4, 3.5: 2, 4.2: 2, 4.3: 5},
    "Definition": {2: 6, 3: 9},
    "Equation": {3: 13, 4: 1},
    "Table": {2: 9, 3: 3, 4: 6},
    "Figure": {1: 1, 2: 24, 3: 8, 4: 22},
}
RESULTS = "2.5"
FORMULAS = ("grad(", "curvature(")  # expressions, not programs
WORDS = {"definition": "Definition", "example": "Definition", "lemma": "Definition", "proposition": "Definition",
         "equation": "Equation", "table": "Table", "figure": "Figure"}
ITEMS = re.compile(rf"\b({'|'.join(WORDS)})s?\s+((?:\d\.\d+(?: \(\w\))?(?: to |, | and )?)+)", re.IGNORECASE)
TEST = re.compile(r"(?:(test_\w+)(?:: )?)?(?:(\w+)\.(\w+))?")


def spread(text):
    """Numbers of '2.3, 2.5 to 2.7 and 2.9', without letters of parts."""
    text = re.sub(r" \(\w\)", "", text)
    for first, last in re.findall(r"(\d\.\d+) to (\d\.\d+)", text):
        chapter = first.split(".")[0]
        numbers = range(int(first.split(".")[1]), int(last.split(".")[1]) + 1)
        text = text.replace(f"{first} to {last}", ", ".join(f"{chapter}.{number}" for number in numbers))
    return re.findall(r"\d\.\d+", text)


def list_missing(text, rows):
    found = {(WORDS[word.lower()], number) for word, numbers in ITEMS.findall(text) for number in spread(numbers)}
    without_items = ITEMS.sub("", rows)
    for section, first, last in re.findall(r"(\d\.\d)\.(\d) to \d\.\d\.(\d)", without_items):
        found.update(("Subsection", f"{section}.{number}") for number in range(int(first), int(last) + 1))
    found.update(("Subsection", number) for number in re.findall(r"(?<![\d.])\d\.\d\.\d(?![\d.])", without_items))
    found.update(("Section", number) for number in re.findall(r"(?<![\d.])\d\.\d(?!\.?\d)", without_items))
    for kind, chapters in NUMBERED.items():
        for chapter, most in chapters.items():
            for number in (f"{chapter}.{last}" for last in range(1, most + 1)):
                if (kind, number) not in found and not (kind == "Section" and number == RESULTS):
                    yield f"{kind} {number} of the thesis is not on the page"


def list_unknown_tests(root, cell):
    file = None
    for name in re.findall(r"`([^`]+)`", cell):
        match = TEST.fullmatch(name)
        if not match:
            continue
        if match.group(1):
            files = list(root.glob(f"tests/**/{match.group(1)}.cpp"))
            if not files:
                yield f"no file {match.group(1)}.cpp"
            file = files[0].read_text() if files else None
        if file and match.group(3) and not re.search(rf"\bTEST(_[FP])?\({match.group(2)},\s*{match.group(3)}\)", file):
            yield f"no test {match.group(2)}.{match.group(3)}"


def list_unknown_programs(root, cell):
    for command in re.findall(r"`([^`]+)`", cell):
        words = command.removeprefix("xvfb-run -a ").split()
        source = f"tools/uvol_{words[1]}.cpp" if words[0] == "uvol" else f"tests/benchmarks/{words[0]}.cpp"
        if re.fullmatch(r"[a-z]\w+", words[0]) and not command.startswith(FORMULAS) and not (root / source).exists():
            yield f"no source {source} of the command {command}"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    root = pathlib.Path(sys.argv[1])
    page = root / "docs/thesis.md"
    text = page.read_text()
    problems, columns, rows = [], [], []
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip("| ").split(" | ")]
        if not line.startswith("|"):
            columns = []
        elif not columns:
            columns = cells
        if line.startswith("|"):
            rows.append(cells[0])
        for column, cell in zip(columns, cells):
            if column == "test":
                problems += list_unknown_tests(root, cell)
            if column == "command" and cells != columns:
                problems += list_unknown_programs(root, cell)
    for path in re.findall(r"`((?:src|include|tests|tools|python|docs)/[\w./]+)`", text):
        if "MODULE" not in path and not (root / path).exists():
            problems.append(f"no file {path}")
    problems += list_missing(text, "\n".join(rows))
    sys.exit("\n".join(f"{page}: {problem}" for problem in problems) or 0)


if __name__ == "__main__":
    main()
