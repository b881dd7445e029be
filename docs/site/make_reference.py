#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pages of the tools, made of what they say about themselves, and the list of them.

usage: make_reference.py BIN_FOLDER DOCS_FOLDER
"""
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/manual"))
import make_pages  # noqa: E402


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
    formats = subprocess.run([bin_folder / "uvol", "--list-formats"], capture_output=True, text=True, check=True).stdout
    page = docs / "reference/tools.md"
    page.write_text(page.read_text().replace("TABLE_OF_TOOLS", "\n".join(rows)))
    page = docs / "reference/formats.md"
    page.write_text(page.read_text().replace("LIST_OF_FORMATS", "".join("    " + line + "\n" for line in formats.splitlines())))


if __name__ == "__main__":
    main()
