#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Names every link of the repository's Markdown files to a file, or to a heading of a page, that is not there.

usage: check_markdown.py REPOSITORY
"""
import functools
import pathlib
import re
import sys

LINK = re.compile(r"\]\(([^)\s#]*)(?:#([^)\s]*))?[^)]*\)")
FOLDERS = ("docs", "tests", "python", "examples", "tools")


@functools.cache
def list_places(page):
    """Names of the headings of a page as GitHub and as MkDocs make them, and of its own anchors."""
    text = page.read_text()
    places = set(re.findall(r'<a (?:id|name)="([^"]+)"', text))
    for heading in re.findall(r"^#+ (.*)$", text, re.MULTILINE):
        words = re.sub(r"[^\w\s-]", "", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)).strip().lower()
        places |= {re.sub(r"\s", "-", words), re.sub(r"[-\s]+", "-", words)}
    return places


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    root = pathlib.Path(sys.argv[1])
    dead = []
    for page in [*root.glob("*.md"), *(page for folder in FOLDERS for page in root.glob(f"{folder}/**/*.md"))]:
        for link, place in LINK.findall(re.sub(r"`[^`]*`", "", page.read_text())):
            file = page.parent / link if link else page
            if "://" in link:
                continue
            if not file.exists():
                dead.append(f"{page.relative_to(root)}: {link}")
            elif place and file.suffix == ".md" and place not in list_places(file.resolve()):
                dead.append(f"{page.relative_to(root)}: {link}#{place} (no such heading)")
    sys.exit("\n".join(dead) or 0)


if __name__ == "__main__":
    main()
