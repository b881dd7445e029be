#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Names every link of the repository's Markdown files to a file that is not there.

usage: check_markdown.py REPOSITORY
"""
import pathlib
import re
import sys

LINK = re.compile(r"\]\(([^)\s#]+)[^)]*\)")
FOLDERS = ("docs", "tests", "python", "examples", "tools")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    root = pathlib.Path(sys.argv[1])
    dead = []
    for page in [*root.glob("*.md"), *(page for folder in FOLDERS for page in root.glob(f"{folder}/**/*.md"))]:
        for link in LINK.findall(re.sub(r"`[^`]*`", "", page.read_text())):
            if "://" not in link and not (page.parent / link).exists():
                dead.append(f"{page.relative_to(root)}: {link}")
    sys.exit("\n".join(dead) or 0)


if __name__ == "__main__":
    main()
