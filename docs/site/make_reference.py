#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pages of the tools, made of what they say about themselves, the list of them, and that of the Python module.

usage: make_reference.py BIN_FOLDER DOCS_FOLDER
"""
import pathlib
import re
import subprocess
import sys

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "tools/manual"))
import make_pages  # noqa: E402
import python_reference  # noqa: E402


def fill(page, name, text):
    """Puts text where the page has, between <!-- NAME --> and <!-- end -->, what readers of the repository see."""
    filled, count = re.subn(f"<!-- {name} -->\n.*?<!-- end -->\n", lambda match: text, page.read_text(), flags=re.DOTALL)
    if count != 1:
        sys.exit(f"{page} has {count} places for {name}.")
    page.write_text(filled)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    bin_folder, docs = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    folder = docs / "reference/tools"
    folder.mkdir(parents=True, exist_ok=True)
    rows = []
    for tool in sorted(bin_folder.glob("uvol_*")):
        page = make_pages.Help(tool)
        (folder / f"{page.name}.md").write_text(make_pages.write_markdown(page))
        purpose = page.purpose.split(". ")[0].rstrip(".").replace("|", "\\|")
        rows.append(f"| [{page.name}](tools/{page.name}.md) | {purpose} |")
    (docs / "reference/python.md").write_text(python_reference.write_page(REPOSITORY / "python/pcl_uvol"))
    formats = subprocess.run([bin_folder / "uvol", "--list-formats"], capture_output=True, text=True, check=True).stdout
    fill(docs / "reference/tools.md", "TABLE_OF_TOOLS", "\n".join(["| tool | |", "|---|---|", *rows, ""]))
    listed = "".join(f"    {line}\n" for line in formats.splitlines())
    fill(docs / "reference/formats.md", "LIST_OF_FORMATS", f"`uvol --list-formats` says:\n\n{listed}")


if __name__ == "__main__":
    main()
