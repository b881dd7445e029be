#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the commands of pages, those in ```sh blocks, each page in a folder of its own, and asks that every
picture (.png) in a folder of pictures/ that a page shows is made by them, and those beside these folders where
commands of the page name them. Each line of a ```text block must be printed by the ```sh block above it, except "..."
and lines that depend on the machine. Below a line <!-- not run: WHY --> a block, also of text, is left
out, and below <!-- long: WHY --> as well, but with --long; commands in indented blocks, which nothing would run,
are refused.

usage: run_commands.py BIN_FOLDER [--long] [--renew] PAGE...; --renew copies the pictures beside the pages
The commands find the tools in PATH, the data sets in $PCL_UVOL_DATA, and the folders tools/ and examples/ of the
repository. Without PCL_UVOL_DATA the pages whose commands use it are skipped; the exit status is then 77 (skipped).
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^(?:<!-- (not run|long): [^\n]+ -->\n)?```sh\n(.*?)^```$", re.MULTILINE | re.DOTALL)
BLOCK_OR_TEXT = re.compile(BLOCK.pattern + r"|^(<!-- not run: [^\n]+ -->\n)?```text\n(.*?)^```$", BLOCK.flags)
MACHINE = re.compile(r"\.\.\.$|memory: |backend: |.*\b\d[\d.e+-]* m?s\b")  # lines that differ between machines
END_OF_BLOCK = "end of block of run_commands.py\n"
INDENTED = re.compile(r"\n\n {4}((?:uvol|cmake|mpirun)[ _].*)")
PICTURE = re.compile(r"\]\(((?:\.\./)?pictures/((?:[a-z]+/)?)([^)/]+\.png))\)")
REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
LINKED = ("tools", "examples")


def find_stale_line(text, run, output):
    """The first line of a text block that the block of commands above it does not print."""
    outputs, printed = iter(output.split(END_OF_BLOCK)), None
    for mark, commands, is_unprinted, shown in BLOCK_OR_TEXT.findall(text):
        if commands:
            printed = {line.strip() for line in next(outputs).splitlines()} if mark in run else None
            continue
        if printed is None or is_unprinted:
            continue
        for line in map(str.strip, shown.splitlines()):
            if line and line not in printed and not MACHINE.match(line):
                return line
    return ""


def run_page(page, bin_folder, flags):
    text = page.read_text()
    lost = INDENTED.search(BLOCK.sub("", text))
    if lost:
        return f"{page}: nothing runs this command, which belongs into a block of sh: {lost.group(1)}"
    run = ("", "long") if "--long" in flags else ("",)
    blocks = BLOCK.findall(text)
    script = "set -euo pipefail\nexec 2>&1\n" + "".join(
        f"{commands}\nprintf '{END_OF_BLOCK.strip()}\\n'\n" for mark, commands in blocks if mark in run)
    left_out = "".join(commands for mark, commands in blocks if mark not in run)
    environment = dict(os.environ, PATH=f"{bin_folder}:{os.environ['PATH']}")
    with tempfile.TemporaryDirectory() as folder:
        for name in LINKED:
            (pathlib.Path(folder) / name).symlink_to(REPOSITORY / name)
        result = subprocess.run(["bash", "-c", script], cwd=folder, env=environment, capture_output=True, text=True)
        if result.returncode != 0:
            return f"{page}: a command failed: {result.stdout.split(END_OF_BLOCK)[-1].strip()}"
        for shown, kind, name in PICTURE.findall(text):
            made = pathlib.Path(folder) / name
            # Those of no kind are the gallery's, which other pages show as well.
            if not made.exists() and (name in left_out or not kind and name not in script):
                continue
            if not made.exists():
                return f"{page}: no command makes {name}"
            if "--renew" in flags:
                target = page.parent / shown
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(made, target)
    stale = find_stale_line(text, run, result.stdout)
    return stale and f"{page}: the commands above it do not print this line: {stale}"


def needs_data_sets(page):
    return any("PCL_UVOL_DATA" in commands for _, commands in BLOCK.findall(page.read_text()))


def main():
    flags = [word for word in sys.argv[1:] if word.startswith("--")]
    words = [word for word in sys.argv[1:] if word not in flags]
    if len(words) < 2 or set(flags) - {"--long", "--renew"}:
        sys.exit(__doc__)
    bin_folder = pathlib.Path(words[0]).resolve()
    pages = [pathlib.Path(word) for word in words[1:]]
    skipped = [] if os.environ.get("PCL_UVOL_DATA") else [page for page in pages if needs_data_sets(page)]
    failures = list(filter(None, (run_page(page, bin_folder, flags) for page in pages if page not in skipped)))
    if skipped and not failures:
        print("run_commands.py: PCL_UVOL_DATA does not name the folder of data sets. Skipped:", *skipped,
              file=sys.stderr)
        sys.exit(77)  # which ctest takes as skipped
    sys.exit("\n".join(failures) or 0)


if __name__ == "__main__":
    main()
