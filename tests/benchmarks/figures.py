#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the tables of docs/benchmarks.md and tests/benchmarks/README.md from the files in tests/benchmarks/results.

usage: figures.py run BIN_FOLDER [NAME...]   run the benchmarks of docs/benchmarks.md (default: all of MEASUREMENTS), and
                                             store what they print as NAME.json
       PROGRAM | figures.py keep NAME        store a table that a program prints as NAME.csv
       figures.py write | check              write the tables of both pages; check fails if they are not up to date
"""
import datetime
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

import tables

HERE = pathlib.Path(__file__).resolve().parent
RESULTS = HERE / "results"
PAGE = HERE.parents[1] / "docs/benchmarks.md"
DISCS = "splats:300000/radius:300/size:1200/depth"
REPEATED = "--benchmark_repetitions=3 --benchmark_min_time=0.1"

# Name: how its output is read, and the command.
MEASUREMENTS = {
    "accuracy_radial": ("rows", "accuracy radial uniform 3 4e6"),
    "accuracy_waves": ("rows", "accuracy waves uniform 3 1e6"),
    "nearest": ("google", f"bench_nearest {REPEATED}"),
    "neighborhoods": ("google", f"bench_neighborhoods --benchmark_filter=/1000000/ {REPEATED}"),
    "rendering": ("google", "xvfb-run -a bench_rendering --benchmark_filter='surface:0/width:1024.*(lines:0/occlusion:0|height:1024)/real_time' "
                  f"{REPEATED}"),
    "ray_tracing": ("google", "env OMP_NUM_THREADS=1 bench_ray_tracing --benchmark_filter='(rayTracer|userGeometry)/splats:300000/radius:300' "
                    f"{REPEATED}"),
    "voronoi": ("google", f"bench_voronoi --benchmark_filter=transform/side:256/points:10000 {REPEATED}"),
    "clusters": ("words", "clusters 1e6"),
    "file_to_file": ("report", "uvol_isosurface radial.pcd out.ply -iso 46 -json"),
}
# What a measurement needs in its folder first.
PREPARED = {"file_to_file": "uvol_generate radial.pcd -n 4000000"}


def read_rows(text):
    """Tables with a head '# name name ...': a list of rows."""
    lines = text.splitlines()
    names = lines[0].lstrip("# ").split()
    return [dict(zip(names, line.split())) for line in lines[1:]]


def read_google(text):
    """Medians by name, in milliseconds: time on the clock and of the processor."""
    factors = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
    medians = {}
    for run in json.loads(text)["benchmarks"]:
        if run.get("aggregate_name") == "median":
            factor = factors[run["time_unit"]]
            medians[run["run_name"]] = {"real_ms": run["real_time"] * factor, "cpu_ms": run["cpu_time"] * factor}
    return medians


def read_words(text):
    """The line of clusters: 'N points, M attributes: ...; step S s ...'."""
    head, _, steps = text.splitlines()[0].partition("; ")
    found = re.findall(r"(\w+) ([0-9.]+) s", steps)
    return {"points": int(head.split()[0]), "adjusted_rand_index": float(head.split()[-1]),
            "seconds": {name: float(seconds) for name, seconds in found}}


def read_report(text):
    report = json.loads(text)
    return {key: report[key] for key in ("counts", "milliseconds")}


READERS = {"rows": read_rows, "google": read_google, "words": read_words, "report": read_report}


def describe_processor():
    text = pathlib.Path("/proc/cpuinfo").read_text()
    name = re.search(r"model name\s*: (.*)", text)
    return f"{os.cpu_count()} cores, {name.group(1) if name else 'unknown processor'}"


def measure(name, bin_folder):
    kind, command = MEASUREMENTS[name]
    environment = dict(os.environ, PATH=f"{bin_folder}:{os.environ['PATH']}", OMP_WAIT_POLICY="passive")
    words = shlex.split(command) + (["--benchmark_format=json"] if kind == "google" else [])
    with tempfile.TemporaryDirectory() as folder:
        if name in PREPARED:
            subprocess.run(shlex.split(PREPARED[name]), cwd=folder, env=environment, check=True, capture_output=True)
        load = os.getloadavg()[0]
        output = subprocess.run(words, cwd=folder, env=environment, check=True, capture_output=True, text=True).stdout
    result = {"command": command, "date": str(datetime.date.today()), "machine": describe_processor(),
              "load_before": round(load, 1), "result": READERS[kind](output)}
    RESULTS.mkdir(exist_ok=True)
    (RESULTS / f"{name}.json").write_text(json.dumps(result, indent=1) + "\n")


def load(name):
    return json.loads((RESULTS / f"{name}.json").read_text())


def largest_mean(rows, method):
    return max(float(row["mean"]) for row in rows if row["method"] == method)


def time_of(medians, start, key="real_ms"):
    return next(values[key] for name, values in medians.items() if name.startswith(start))


def format_time(milliseconds):
    seconds = milliseconds / 1000
    return f"{milliseconds:.3g} ms" if seconds < 1 else f"{seconds:.2g} s" if seconds < 100 else f"{seconds:.0f} s"


def list_accuracy():
    for name, what in (("accuracy_radial", "smooth field, 4,000,000 samples"),
                       ("accuracy_waves", "waves of twenty spacings, 1,000,000 samples")):
        rows = load(name)["result"]
        yield (name, what, *(f"{largest_mean(rows, method):.2g}" for method in ("smooth", "linear", "marching_cubes")))


# Row: its measurement, what is measured, what it is compared with, and beginnings of the names of both benchmarks.
ROWS = {
    "nearest": ("nearest", "41 nearest of 4,000,000 samples at 54,982 isopoints, one thread", "FLANN", "uvolFinder",
                "flannNearSurface"),
    "neighborhoods": ("neighborhoods", "neighbours of 1,000,000 samples", "CGAL's Delaunay triangulation with TBB",
                      "whole_job/uvol", "whole_job/cgal"),
    "rendering": ("rendering", "image of 544,000 points, 1024 x 1024, no graphics card", "VTK, plain points",
                  "imageSpace", "vtkPointMapper"),
    "rays": ("ray_tracing", "ray tracing of 300,000 splats, 1200 x 1200, light and shadow, one thread", "Embree, one pass",
             f"rayTracer/{DISCS}:0", f"embree/userGeometry/{DISCS}:0"),
    "mirrored_rays": ("ray_tracing", "the same with four reflections, one thread", "Embree, one pass", f"rayTracer/{DISCS}:4",
                      f"embree/userGeometry/{DISCS}:4"),
    "voronoi": ("voronoi", "discrete Voronoi diagram, 10,000 points, 256³", "the thesis", "transform", None),
    "clusters": ("clusters", "clusters of 998,250 points, 6 attributes", "", None, None),
    "file_to_file": ("file_to_file", "surface of 4,000,000 samples, from file to file", "", None, None),
}


def list_times():
    """Rows of the table: times on a quiet machine, and how the last run compares, whose machine had a load."""
    quiet = json.loads((RESULTS / "quiet.json").read_text())
    for row, (name, what, peer, ours, theirs) in ROWS.items():
        known, run = quiet[row], load(name)
        beside = f"{format_time(known['beside'])}: {peer}" if peer else ""
        ratio = f"{known['beside'] / known['ours']:.2g}" if peer and peer != "the thesis" else ""
        last = ""
        if theirs:
            key = "cpu_ms" if "one thread" in what else "real_ms"
            last = f"{time_of(run['result'], theirs, key) / time_of(run['result'], ours, key):.2g}, load {run['load_before']:.0f}"
        yield (what, format_time(known["ours"]), beside, ratio, known["machine"], last)


def write_tables():
    lines = ["Mean distance to the true surface, in sample spacings; the largest of three seeds.", "",
             "| field | pcl_uvol | isopoints on edges (thesis) | marching cubes on a grid with as many exact values |",
             "|---|---|---|---|"]
    for name, what, *figures in list_accuracy():
        lines.append(f"| {what} | " + " | ".join(figures) + " |")
    machines = sorted({load(name)["machine"] for name, *_ in ROWS.values()})
    dates = sorted({load(name)["date"] for name, *_ in ROWS.values()})
    lines += ["", "Times are those of quiet [machines](../tests/benchmarks/README.md#machines) with two virtual cores. The ratio says how many times as "
              "long the other library takes. The last column shows whether the ratios still hold. The last run "
              f"({dates[-1]}, {'; '.join(machines)}) was on a busy machine, whose load is the number of programs that waited for the cores. Load "
              "lengthens all times, and disturbs ratios of programs with several threads.", "",
              "| task | pcl_uvol | compared with | ratio | machine | ratio of the last run |", "|---|---|---|---|---|---|"]
    lines += ["| " + " | ".join(row) + " |" for row in list_times()]
    lines += ["", "The commands, in this order. Those of Google Benchmark (`bench_...`) also need `--benchmark_format=json`:", ""]
    lines += [f"    {' && '.join(filter(None, (PREPARED.get(name), load(name)['command'])))}" for name in MEASUREMENTS]
    return "\n".join(lines)


def update(text):
    begin, end = "<!-- tables by figures.py: begin -->\n", "<!-- tables by figures.py: end -->"
    before, _, rest = text.partition(begin)
    _, _, after = rest.partition(end)
    return f"{before}{begin}\n{write_tables()}\n\n{end}{after}"


PAGES = {PAGE: update, tables.PAGE: tables.update_page}


def main():
    words = sys.argv[1:]
    if len(words) > 1 and words[0] == "run" and set(words[2:]) <= set(MEASUREMENTS):
        for name in words[2:] or MEASUREMENTS:
            measure(name, pathlib.Path(words[1]).resolve())
    elif len(words) == 2 and words[0] == "keep":
        tables.keep_table(words[1], sys.stdin.read())
    elif words == ["write"]:
        for page, update_page in PAGES.items():
            page.write_text(update_page(page.read_text()))
    elif words == ["check"]:
        old = [str(page) for page, update_page in PAGES.items() if update_page(page.read_text()) != page.read_text()]
        if old:
            sys.exit(f"The results have other numbers than {' and '.join(old)}. Run {sys.argv[0]} write.")
        unmarked = tables.count_unmarked(tables.PAGE.read_text())
        if unmarked:
            sys.exit(f"{unmarked} tables of {tables.PAGE} have no comment with the name of their results above them.")
        unused = tables.list_unused(tables.PAGE.read_text())
        sys.exit(f"{tables.PAGE} has no table of {', '.join(unused)}." if unused else 0)
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
