#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares what the tools do with what they did before: which columns of fifty header lines they take as coordinates,
which files of other programs they read, and what a run costs compared with a plain one.

usage: run.py FOLDER_OF_TOOLS headers|files|costs [-write]

The lists headers.txt, files.txt and costs.txt have lines "WHAT -> ANSWER". The check prints the lines whose answer
changed, and exits with 1. With -write it changes these lines, and keeps comments and remarks. The remark "  # open: ..."
marks an answer that users would not expect. To add a header line, write "HEADER -> ?" into headers.txt and use -write.
Exit code 77: the folder of files is not there."""

import csv
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ARROW = " -> "
REMARK = "  # "


class RatchetList:
    """The lines of a list. Lines without an arrow are comments, because headers may begin with a comment sign."""

    def __init__(self, name):
        self.path = HERE / f"{name}.txt"
        self.lines = self.path.read_text(encoding="utf-8").splitlines()
        self.answers, self.remarks = {}, {}
        for line in self.lines:
            if ARROW in line:
                key, _, rest = line.rpartition(ARROW)
                answer, sign, remark = rest.partition(REMARK)
                self.answers[key], self.remarks[key] = answer, sign + remark

    def write(self, changes):
        """Change answers where they are. An answer of None removes its line; new lines are appended."""
        lines = []
        for line in self.lines:
            key = line.rpartition(ARROW)[0]
            if key not in changes:
                lines.append(line)
            elif changes[key] is not None:
                lines.append(key + ARROW + changes[key] + self.remarks[key])
        lines += [key + ARROW + changes[key] for key in sorted(set(changes) - set(self.answers))]
        self.path.write_text("\n".join(lines) + "\n", encoding="utf-8")


# --- Reading ---------------------------------------------------------------------------------------------------------


def describe(tools, file):
    """The report of uvol_info, or a word if there is none. Each file has its own run, because a file can change how the
    next one of a command is read: one in degrees gives its map to all that follow."""
    run = subprocess.run([tools / "uvol_info", file, "-json", "-threads", "1"], capture_output=True, encoding="utf-8")
    if run.returncode == 0:
        return json.loads(run.stdout)
    return "refused" if run.returncode == 1 else f"failed ({run.returncode})"


def field_names(report):
    """The fields of a report, without coordinates. A name may contain commas, so each one is found by its type. A report
    lists the first 200 fields and counts the others."""
    listed, more = re.fullmatch(r"(.*?)(?: and (\d+) more)?", report["fields"]).groups()
    names = re.findall(r"(.+?) \((?:u?int|float)\d+(?: x \d+)?\)(?:, |$)", listed) + ["..."] * int(more or 0)
    return names[3:] if names[:3] == ["x", "y", "z"] else names


# --- Header lines ----------------------------------------------------------------------------------------------------

# Columns of these names get text or times, because people have these in them. The others get numbers.
TEXT_NAMES = {"bhid", "holeid", "hole_id", "hole", "bohrung", "formation", "lith"}
TIME_NAMES = {"time", "timestamp", "date", "datum"}
ROWS = 13


def split_header(header):
    """The separator of a header, and the names in it. Of several lines, the header is the last one with the most names
    that is not a line of units."""
    separator = next((sign for sign in "\t;," if sign in header.split("\n")[-1]), " ")
    best = []
    for line in header.lstrip("\ufeff").split("\n"):
        line = re.sub(r"^\s*(#|%|!|//)\s*", "", line)
        if separator == " ":
            names = line.split()
        else:
            names = next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
        if len(names) >= len(best) and not (best and set(names) <= {"m", "degC"}):
            best = names
    return separator, [name.strip() for name in best]


def cell(name, row, column, columns):
    if name.lower() in TEXT_NAMES:
        return f"DH-{row // 4}"
    if name.lower() in TIME_NAMES:
        return f"2024-05-01T10:{row:02d}:00Z"
    if not name and column == columns - 1:
        return ""  # a separator at the end of all lines
    # The whole part is the number of the column, so that the corners of the region tell which columns are coordinates.
    return f"{column + 0.1 + 0.8 * (row * (column + 1) % ROWS) / ROWS:.3f}"


def check_headers(tools, recorded):
    answers = {}
    with tempfile.TemporaryDirectory() as folder:
        for key in recorded.answers:
            header = key.replace("\\t", "\t").replace("\\n", "\n").replace("\\ufeff", "\ufeff")
            separator, names = split_header(header)
            file = pathlib.Path(folder) / ("table.txt" if separator == " " else "table.csv")
            rows = [separator.join(cell(name, row, i, len(names)) for i, name in enumerate(names))
                    for row in range(ROWS)]
            file.write_text("\n".join([header, *rows]) + "\n", encoding="utf-8")
            answers[key] = columns_taken(describe(tools, file), names)
    return answers


def columns_taken(report, names):
    if isinstance(report, str):
        return report
    rows = report["counts"]["points"]
    taken = "no coordinates"
    if "lower_corner" in report:
        columns = [int(abs(value)) for value in report["lower_corner"]]
        taken = "coordinates " + " | ".join(names[i] if i < len(names) else f"column {i}" for i in columns)
    fields = field_names(report)
    return taken + (", fields " + " | ".join(fields) if fields else ", no fields") + (
        "" if rows == ROWS else f", {rows} of {ROWS} rows")


# --- Files of other programs -----------------------------------------------------------------------------------------


def check_files(tools, _):
    """What is read of each file. The folder is next to the real data sets, which other tests find in the same way."""
    data = pathlib.Path(os.environ.get("PCL_UVOL_DATA", HERE.parents[1] / ".." / "shared" / "data"))
    wild = data / ".." / "wild"
    if not wild.is_dir():
        print("run.py: there is no folder of files of other programs ($PCL_UVOL_DATA/../wild).", file=sys.stderr)
        sys.exit(77)
    files = sorted(file for part in ("made", "real") for file in (wild / part).rglob("*")
                   if file.is_file() and file.suffix != ".md")
    return {file.relative_to(wild).as_posix(): sizes(describe(tools, file)) for file in files}


def sizes(report):
    if isinstance(report, str):
        return report
    points, fields = report["counts"]["points"], len(field_names(report))
    placed = "" if "lower_corner" in report or points == 0 else ", no coordinates"
    return f"read {points} points {fields} fields" + placed


# --- Costs -----------------------------------------------------------------------------------------------------------

DATA = ["uvol_generate sphere.pcd -n 2000000 -field sphere",
        "uvol_convert sphere.pcd sphere.vtkhdf",
        "uvol_generate gyroid.pcd -n 250000 -field gyroid",
        "uvol_generate noisy.pcd -n 200000 -field hydrogen -noise 0.03",
        "uvol_generate holes.csv -n 20000 -field sphere -samples holes"]
# Each run, and the plain run of the same data. Runs of the same data follow one another, so that other programs slow
# them down alike. The bound has to be small enough that a broken bound shows: its double takes 1.9 times the memory.
SPHERE = "uvol_isosurface sphere.pcd out.ply -iso 0.2"
GYROID = "uvol_isosurface gyroid.pcd out.ply -iso 0.8"
NOISY = "uvol_isosurface noisy.pcd out.ply -iso 0.3"
HOLES = "uvol_isosurface holes.csv out.ply -field sphere -iso 0.2"
COSTS = {"HDF5 in": ("uvol_isosurface sphere.vtkhdf out.ply -iso 0.2", SPHERE),
         "bounded": (SPHERE + " -max-memory 160M", SPHERE),
         "mesh": (GYROID + " -mesh", GYROID),
         "smooth": (NOISY + " -smooth", NOISY),
         "levelset": ("uvol_levelset noisy.pcd out.ply -iso 0.3", NOISY),
         "fill-gaps": (HOLES + " -fill-gaps", HOLES)}
# Chosen from 13 rounds on two hardware threads under a load of 5. Memory ratios differed by a factor of at most 1.02;
# the tolerance leaves room for the libraries of other systems. Time ratios differed by up to 1.8 between the minima of
# 3 rounds, 1.17 of 6 and 1.10 of 9. So rounds are added, up to 9, while a ratio is outside of its tolerance.
LEAST_ROUNDS, MOST_ROUNDS = 3, 9
TOLERANCE = {"memory": 1.1, "time": 1.25}


def measure(tools, command, folder):
    """Peak memory in bytes and processor time in seconds. With one thread, neither depends on the number of cores."""
    tool, *arguments = command.split()
    # The peak of a child includes that of this process, from which it starts: it imports little to stay far below.
    child = subprocess.Popen([tools / tool, *arguments, "-threads", "1"], cwd=folder, stdout=subprocess.DEVNULL,
                             stderr=subprocess.PIPE)
    errors = child.stderr.read().decode(errors="replace")
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit(f"run.py: {command} failed with {child.returncode}:\n{errors}")
    return usage.ru_maxrss * 1024, usage.ru_utime + usage.ru_stime


def check_costs(tools, recorded):
    commands = dict.fromkeys(command for pair in COSTS.values() for command in reversed(pair))
    # Other programs only add to a time: the least one is nearest to that of a quiet machine.
    least = {command: (float("inf"), float("inf")) for command in commands}
    with tempfile.TemporaryDirectory() as folder:
        for command in DATA:
            measure(tools, command, folder)
        for done in range(1, MOST_ROUNDS + 1):
            for command in commands:
                least[command] = tuple(map(min, least[command], measure(tools, command, folder)))
            ratios = {name: [a / b for a, b in zip(least[run], least[plain])] for name, (run, plain) in COSTS.items()}
            answers = {name: "memory {:.2f}, time {:.2f}".format(*pair) for name, pair in ratios.items()}
            same = [same_costs(recorded.answers.get(name, ""), answer) for name, answer in answers.items()]
            if done >= LEAST_ROUNDS and all(same):
                break
    for name, (run, plain) in COSTS.items():
        print("{:9} {:4.0f} MB {:5.2f} s, plain {:4.0f} MB {:5.2f} s: {}".format(
            name, least[run][0] / 2**20, least[run][1], least[plain][0] / 2**20, least[plain][1], answers[name]))
    print(f"{done} rounds")
    return answers


def same_costs(old, new):
    """Whether ratios are within their tolerance, in both directions: a gain that is not recorded hides the next loss."""
    ratios = [dict(re.findall(r"(\w+) ([\d.]+)", answer)) for answer in (old, new)]
    return all(name in ratios[0] and 1 / factor <= float(ratios[1][name]) / float(ratios[0][name]) <= factor
               for name, factor in TOLERANCE.items())


CHECKS = {"headers": check_headers, "files": check_files, "costs": check_costs}


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "-write"]
    if len(arguments) != 2 or arguments[1] not in CHECKS:
        sys.exit(__doc__)
    tools, name = pathlib.Path(arguments[0]).resolve(), arguments[1]
    recorded = RatchetList(name)
    answers = CHECKS[name](tools, recorded)
    same = same_costs if name == "costs" else str.__eq__
    changes = {}
    for key in {**recorded.answers, **answers}:
        old, new = recorded.answers.get(key), answers.get(key)
        if old is None or new is None or not same(old, new):
            changes[key] = new
            for sign, answer in (("-", old), ("+", new)):
                if answer is not None:
                    print(f"{sign} {key}{ARROW}{answer}")
    if "-write" in sys.argv:
        recorded.write(changes)
    elif changes:
        sys.exit(f"{len(changes)} of {len(answers)} lines of tests/ratchets/{name}.txt changed. If this is meant, run\n"
                 f"  python3 tests/ratchets/run.py FOLDER_OF_TOOLS {name} -write\n"
                 "and say in the commit which lines change, and why.")


if __name__ == "__main__":
    main()
