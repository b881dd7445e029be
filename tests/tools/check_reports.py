#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs every tool with -json, by the commands of tests/bytes and some more, and holds the reports against the schema
that the documentation has.

usage: check_reports.py BIN_FOLDER REPOSITORY [FOLDER]
FOLDER is what tests/bytes/run.sh -keep has left: its commands are not run again.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

# Kinds of reports that the commands of tests/bytes do not have.
FURTHER = """
uvol_isosurface noisy.pcd validated.ply -iso 0.3 -validate 3
uvol_isosurface star.pcd logarithms.ply -field star -iso 0.01 -smooth
uvol_isosurface noisy.pcd both.ply -iso 0.2,0.3 -smooth -mu 0.5 -steps 5 -validate 2
uvol_info probe_grid.nrrd star.pcd
uvol_isosurface star.pcd filled.ply -field star -iso 0.01 -fill-gaps
uvol_isosurface gyroid.ply repeated.ply -iso 0 -periodic 12.56637061,12.56637061,12.56637061
uvol_generate holes.csv -n 3000 -field gyroid -samples holes
uvol_info holes.csv -out sampling.csv
"""

# A file that is not there, an option that is not known, an expression that ends too early, a value that is too large.
FAILING = """
uvol_isosurface none.pcd out.ply -iso 0
uvol_isosurface noisy.pcd out.ply -izo 0
uvol_isosurface noisy.pcd out.ply -iso 0 -field sqrt(
uvol_info noisy.pcd -threads 100000
"""


def split(printed):
    """The reports that a command has printed: one of each file that it tells of."""
    reports, rest = [], printed.strip()
    while rest:
        report, end = json.JSONDecoder().raw_decode(rest)
        reports.append(report)
        rest = rest[end:].strip()
    return reports


def run(command, bin_folder, folder, fails=False):
    tool, *words = command.split()
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    result = subprocess.run([bin_folder / tool, *words, "-json"], cwd=folder, env=environment, capture_output=True,
                            text=True)
    if fails != (result.returncode != 0):
        sys.exit(f"{command} failed: {result.stderr}")
    return split(result.stdout)


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    try:
        import jsonschema
    except ImportError:
        print("check_reports.py: there is no module jsonschema (python3-jsonschema).", file=sys.stderr)
        sys.exit(77)  # which ctest takes as skipped
    bin_folder, root = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    schema = json.loads((root / "docs/reference/report.schema.json").read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    failures, seen = [], set()

    def check(command, report):
        seen.update(report)
        for error in validator.iter_errors(report):
            place = ".".join(str(part) for part in error.path)
            failures.append(f"{command}: {place or 'the report'}: {error.message[:300]}")
        if not list(validator.iter_errors(dict(report, unknown=1))):
            failures.append(f"{command}: the schema takes keys that nobody knows.")

    with tempfile.TemporaryDirectory() as new:
        kept = sys.argv[3] if len(sys.argv) > 3 else ""
        for path in sorted(pathlib.Path(kept + ".reports").glob("*")):
            for report in split(path.read_text()):
                check(path.name, report)
        commands = FURTHER if kept else (root / "tests/bytes/commands.txt").read_text() + FURTHER
        for command in commands.splitlines():
            if command and not command.startswith("#") and (bin_folder / command.split()[0]).exists():
                for report in run(command, bin_folder, kept or new):
                    check(command, report)
        for command in FAILING.split("\n")[1:-1]:
            reports = run(command, bin_folder, kept or new, fails=True)
            if len(reports) != 1 or "error" not in reports[0]:
                failures.append(f"{command}: its report has no error.")
            for report in reports:
                check(command, report)
    unseen = set(schema["properties"]) - seen - {"files", "further_numbers_per_point"}
    failures += [f"No command here prints the key {key} of the schema." for key in sorted(unseen)]
    sys.exit("\n".join(failures) or 0)


if __name__ == "__main__":
    main()
