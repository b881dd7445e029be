# SPDX-License-Identifier: BSD-3-Clause
"""Tables of tests/benchmarks/README.md: each is written from tests/benchmarks/results/NAME.csv, where a comment
<!-- table: NAME --> is above it."""
import csv
import io
import pathlib
import re

HERE = pathlib.Path(__file__).resolve().parent
RESULTS = HERE / "results"
PAGE = HERE / "README.md"
TABLE = re.compile(r"(<!-- table: (\w+) -->\n\n)(?:(?:\|.*\n)+\n*)?")


def read_table(text):
    """Rows of a table that a program printed, as Markdown or as CSV; the first one has the names of the columns."""
    lines = [line for line in text.splitlines() if line.startswith("|")]
    if not lines:
        return list(csv.reader(io.StringIO(text)))
    rows = [re.split(r"(?<!\\)\|", line.strip()[1:].removesuffix("|")) for line in lines]
    rows = [[cell.strip().replace("\\|", "|") for cell in row] for row in rows]
    return [row for row in rows if not all(re.fullmatch(r":?-+:?", cell) for cell in row)]


def format_table(rows):
    def line(cells):
        return "|" + "".join(f" {cell} |" if cell else " |" for cell in cells) + "\n"

    escaped = [[cell.replace("|", "\\|") for cell in row] for row in rows]
    return line(escaped[0]) + "|" + "---|" * len(escaped[0]) + "\n" + "".join(line(row) for row in escaped[1:])


def load_table(name):
    with open(RESULTS / f"{name}.csv", newline="") as file:
        return list(csv.reader(file))


def keep_table(name, text):
    """Stores a printed table. An existing file keeps its columns, which are found by name, or else by their order."""
    rows = read_table(text)
    path = RESULTS / f"{name}.csv"
    if path.exists():
        names = load_table(name)[0]
        if set(names) < set(rows[0]):
            places = [rows[0].index(column) for column in names]
            rows = [[row[place] for place in places] for row in rows]
        rows[0] = names
    if any(len(row) != len(rows[0]) for row in rows):
        raise ValueError(f"{path} needs {len(rows[0])} columns in each row.")
    with open(path, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)


def update_page(text):
    return TABLE.sub(lambda table: table.group(1) + format_table(load_table(table.group(2))) + "\n", text)


def count_unmarked(text):
    """Tables without a comment above them."""
    marked = re.sub(r"<!-- table: \w+ -->\n\n(\|.*\n)+", "", text)
    return len(re.findall(r"^\|---", marked, re.MULTILINE))


def list_unused(text):
    """Results that no table shows."""
    shown = {name for _, name in TABLE.findall(text)}
    return sorted(path.name for path in RESULTS.glob("*.csv") if path.stem not in shown)
