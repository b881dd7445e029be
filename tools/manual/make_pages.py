#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Manual pages (troff) and reference pages (Markdown) of the tools, made of what their -h all prints.

usage: make_pages.py man|markdown BIN_FOLDER OUTPUT_FOLDER [TOOL...]
"""
import os
import pathlib
import re
import subprocess
import sys
import textwrap

ENTRY = re.compile(r"^  (-\S+(?: \S+)?)(?:\s+(.*))?$")
COLUMNS = re.compile(r"^ |\S {2,}\S")


def split_columns(text):
    """What stands before the first line that is indented or in columns, and the lines from there on."""
    lines = text.splitlines()
    start = next((i for i, line in enumerate(lines) if COLUMNS.search(line)), len(lines))
    return " ".join(" ".join(lines[:start]).split()), textwrap.dedent("\n".join(lines[start:])).splitlines()


class Help:
    """Purpose, usage and options by heading, as a tool prints them."""

    def __init__(self, tool):
        def run(*words):
            # Libraries of MPI do not free all they have, which ends tools that look for leaks.
            environment = dict(os.environ, ASAN_OPTIONS="detect_leaks=0")
            return subprocess.run([tool, *words], capture_output=True, text=True, check=True, env=environment).stdout

        text = run("-h", "all")
        purpose, _, rest = text.partition("\n\nUsage: ")
        self.name = pathlib.Path(tool).name
        self.version = run("-version").split()[-1]
        self.purpose, self.table = split_columns(purpose)
        self.usage, _, rest = rest.partition("\n")
        self.groups = []  # of (heading, entries), an entry of [option, help]
        for line in rest.splitlines():
            entry = ENTRY.match(line)
            if line.endswith(":") and not line.startswith(" "):
                self.groups.append((line[:-1], []))
            elif entry:
                # The help starts in its column, two blanks behind a long option, or in the next line.
                option, _, words = line.strip().partition("  ")
                if not words and line[29:30] == " ":
                    option, words = line[2:30].strip(), line[30:]
                self.groups[-1][1].append([option, words.strip()])
            elif line.strip():
                self.groups[-1][1][-1][1] += " " + line.strip()


def write_man(page):
    def escape(text):
        text = text.replace("\\", "\\e").replace("-", "\\-")
        return "\\&" + text if text[:1] in ".'" else text

    summary = page.purpose.split(". ")[0].rstrip(".")
    lines = [f'.TH {page.name.upper()} 1 "" "pcl_uvol {page.version}" "User Commands"',
             ".SH NAME", f"{page.name} \\- {escape(summary[0].lower() + summary[1:])}",
             ".SH SYNOPSIS", f".B {escape(page.usage.split()[0])}", escape(page.usage.partition(" ")[2]),
             ".SH DESCRIPTION", escape(page.purpose), *([".PP", ".nf", *map(escape, page.table), ".fi"] if page.table else []),
             ".SH OPTIONS",
             "Two dashes are as good as one, and \\-\\-name=value is \\-name value."]
    for heading, entries in page.groups:
        lines.append(f'.SS "{heading}"')
        for option, words in entries:
            name, _, placeholder = option.partition(" ")
            lines += [".TP", f"\\fB{escape(name)}\\fR" + (f" \\fI{escape(placeholder)}\\fR" if placeholder else ""),
                      escape(words)]
    lines += [".SH EXIT STATUS", "0 for success, 1 for a failure with one sentence on standard error, "
              "2 for a wrong command line.", ".SH SEE ALSO", ".BR uvol (1)"]
    return "\n".join(lines) + "\n"


def write_markdown(page):
    def escape(text):
        return text.replace("|", "\\|").replace("<", "&lt;").replace("*", "\\*")

    table = ["```text", *page.table, "```", ""] if page.table else []
    lines = [f"# {page.name}", "", page.purpose, "", *table, "```text", page.usage, "```", ""]
    for heading, entries in page.groups:
        lines += [f"## {heading}", "", "| option | |", "|---|---|"]
        lines += ["| `" + option.replace("|", "\\|") + "` | " + escape(words) + " |" for option, words in entries]
        lines.append("")
    return "\n".join(lines)


def main():
    if len(sys.argv) < 4 or sys.argv[1] not in ("man", "markdown"):
        sys.exit(__doc__)
    kind, folder, output = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    output.mkdir(parents=True, exist_ok=True)
    names = sys.argv[4:] or sorted(path.name for path in folder.glob("uvol_*"))
    for name in names:
        page = Help(folder / name)
        if kind == "man":
            (output / f"{name}.1").write_text(write_man(page))
        else:
            (output / f"{name}.md").write_text(write_markdown(page))


if __name__ == "__main__":
    main()
