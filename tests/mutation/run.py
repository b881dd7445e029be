#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do the tests see the numbers inside kernels? Changes one line at a time, builds what depends on it,
runs the tests named beside it, and tells which changes no test noticed.

usage: tests/mutation/run.py [-j THREADS] [WORD...]     mutations whose file or name holds a word; default: all
       tests/mutation/run.py --list [WORD...]           their names, and whether the list fits the sources

Works on a copy of the tree in build/mutation, which is kept for the next time. Refuses a list that
no longer fits the sources (exit code 2). Exit code 1 if less than 90 % of the changes are noticed."""

import argparse
import functools
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIST = pathlib.Path(__file__).resolve().parent / "mutations.txt"
COPY = ROOT / "build" / "mutation"
BUILD = COPY / "build" / "release"
LEAST_SHARE = 0.9
# A mutation may make a test run for ever: its limit is that factor of the time without one, and some room.
TIME_FACTOR, TIME_ROOM = 10.0, 20.0


class Mutation:
    """Blocks of the list: "# name", "file: test test tool", "- old line", "+ new line"; a test is the name of its source,
    and tools are what the tests run."""

    def __init__(self, block):
        if len(block) != 4 or [line[0] for line in block[0::2]] != ["#", "-"] or block[3][0] != "+":
            fail("not a mutation:\n" + "\n".join(block))
        self.name = block[0][1:].strip()
        self.file, tests = block[1].split(":")
        self.tests = [name for name in tests.split() if name.startswith("test_")]
        self.targets = {executable_of(name)[0] if name in self.tests else name for name in tests.split()}
        self.old, self.new = block[2][1:].strip(), block[3][1:].strip()

    def mutated(self, text):
        """The text with the new line; None if the old one is not in it exactly once."""
        lines = text.split("\n")
        places = [i for i, line in enumerate(lines) if line.strip() == self.old]
        if len(places) != 1:
            return None
        lines[places[0]] = self.new
        return "\n".join(lines)


def fail(message):
    sys.exit(f"{pathlib.Path(__file__).name}: {message}")


@functools.cache
def executable_of(test):
    """The executable of a source of tests, and the filter of its suites, as tests/CMakeLists.txt has them."""
    sources = list((ROOT / "tests").rglob(test + ".cpp"))
    if len(sources) != 1:
        fail(f"there is not one source of tests of the name {test}.")
    text = sources[0].read_text()
    module = "kernels" if '#include "src/' in text else sources[0].relative_to(ROOT / "tests").parts[0]
    suites = sorted(set(re.findall(r"^(?:TEST|TEST_F|TEST_P|TYPED_TEST)\((\w+),", text, re.MULTILINE)))
    return "test_" + module, ":".join(f"{suite}.*:{suite}/*:*/{suite}.*" for suite in suites)


def read_list(words):
    blocks = LIST.read_text().split("\n\n")
    mutations = [Mutation(block.strip("\n").split("\n")) for block in blocks if block.strip()]
    stale = [m for m in mutations if m.mutated((ROOT / m.file).read_text()) is None]
    if stale:
        print("Old lines that are not in their file exactly once: bring mutations.txt up to date.", file=sys.stderr)
        for m in stale:
            print(f"  {m.file}: {m.name}\n    {m.old}", file=sys.stderr)
        sys.exit(2)
    return [m for m in mutations if not words or any(w in m.file + " " + m.name for w in words)]


def copy_tree():
    """Files that git knows or would take; those that did not change keep their time."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, check=True,
                            capture_output=True, text=True).stdout.split("\0")
    wanted = {name for name in listed if name and (ROOT / name).is_file()}
    for folder, folders, files in os.walk(COPY):
        if pathlib.Path(folder) == COPY and "build" in folders:
            folders.remove("build")
        for file in files:
            path = pathlib.Path(folder) / file
            if str(path.relative_to(COPY)) not in wanted:
                path.unlink()
    for name in wanted:
        source, target = ROOT / name, COPY / name
        if not target.exists() or target.read_bytes() != source.read_bytes():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, target)


def build(targets, threads):
    """The log of a build that failed, else nothing."""
    run = subprocess.run(["cmake", "--build", str(BUILD), "-j", str(threads), "--target", *sorted(targets)],
                         capture_output=True, text=True)
    return run.stdout + run.stderr if run.returncode != 0 else ""


def passes(test, limit):
    """Without what is labelled long: a mutation is to be noticed by the tests that everybody runs."""
    executable, suites = executable_of(test)
    command = [str(BUILD / "bin" / executable), f"--gtest_filter={suites}-*_long*", "--gtest_fail_fast", "--gtest_brief=1"]
    try:
        run = subprocess.run(command, cwd=COPY, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=limit)
    except subprocess.TimeoutExpired:
        return False
    return run.returncode == 0


def check_unmutated(mutations, threads):
    """Seconds that every test takes."""
    log = build({target for m in mutations for target in m.targets}, threads)
    if log:
        fail("the tree does not build:\n" + log)
    seconds = {}
    for test in sorted({test for m in mutations for test in m.tests}):
        start = time.monotonic()
        if not passes(test, None):
            fail(f"{test} fails without any mutation.")
        seconds[test] = time.monotonic() - start
    return seconds


def try_mutation(mutation, seconds, threads):
    """What became of it: killed, survived, or broken if it does not compile."""
    path = COPY / mutation.file
    text = path.read_text()
    path.write_text(mutation.mutated(text))
    try:
        if build(mutation.targets, threads):
            return "broken"
        is_killed = any(not passes(test, TIME_FACTOR * seconds[test] + TIME_ROOM) for test in mutation.tests)
        return "killed" if is_killed else "survived"
    finally:
        path.write_text(text)


def print_shares(results):
    by_folder = {}
    for mutation, result in results:
        folder = str(pathlib.Path(mutation.file).parent).removeprefix("src/")
        by_folder.setdefault(folder, []).append(result)
    print()
    for folder, outcomes in sorted(by_folder.items()):
        print(f"{folder:24s} {outcomes.count('killed'):3d} of {len(outcomes):3d}")
    for mutation, result in results:
        if result != "killed":
            print(f"{result}: {mutation.file}: {mutation.name}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-j", type=int, default=os.cpu_count(), metavar="THREADS", dest="threads")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("words", nargs="*", metavar="WORD")
    options = parser.parse_args()
    mutations = read_list(options.words)
    if not mutations:
        fail("no mutation has such a name.")
    if options.list:
        for mutation in mutations:
            print(f"{mutation.file}: {mutation.name}")
        return
    copy_tree()
    # Flags are those of the tree, so that a compiler cache has what no mutation touches; and none of them
    # changes the interface of a library.
    subprocess.run(["cmake", "--preset", "release", "-DCMAKE_LINK_DEPENDS_NO_SHARED=ON"], cwd=COPY, check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    seconds = check_unmutated(mutations, options.threads)
    results = []
    for mutation in mutations:
        start = time.monotonic()
        results.append((mutation, try_mutation(mutation, seconds, options.threads)))
        print(f"{results[-1][1]:8s} {time.monotonic() - start:6.1f} s  {mutation.file}: {mutation.name}", flush=True)
    print_shares(results)
    killed = sum(result == "killed" for _, result in results)
    share = killed / len(results)
    print(f"{killed} of {len(results)} killed: {100 * share:.1f} %")
    sys.exit(0 if share >= LEAST_SHARE and not any(result == "broken" for _, result in results) else 1)


if __name__ == "__main__":
    main()
