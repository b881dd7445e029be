#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Names every link of a site's own pages to a file or place that is not there.

usage: check_links.py SITE_FOLDER
"""
import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    """Links of a page, and the names of its places."""

    def __init__(self, path):
        super().__init__()
        self.links, self.places = [], set()
        self.feed(path.read_text(encoding="utf-8", errors="replace"))

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        self.places.update(values[key] for key in ("id", "name") if values.get(key))
        self.links += [values[key] for key in ("href", "src") if values.get(key)]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    root = pathlib.Path(sys.argv[1]).resolve()
    # Doxygen's pages are Doxygen's own; links to them are checked.
    pages = {path: Page(path) for path in root.rglob("*.html") if path.parent.name != "api"}
    dead = []
    for path, page in pages.items():
        for link in page.links:
            target, _, place = link.partition("#")
            if urllib.parse.urlparse(link).scheme or target.startswith("/") or path.name == "404.html":
                continue
            file = (path.parent / urllib.parse.unquote(target)).resolve() if target else path
            if not file.exists():
                dead.append(f"{path.relative_to(root)}: {link}")
            elif place and file in pages and urllib.parse.unquote(place) not in pages[file].places:
                dead.append(f"{path.relative_to(root)}: {link} (no such place)")
    print("\n".join(sorted(set(dead))), end="\n" if dead else "")
    sys.exit(1 if dead else 0)


if __name__ == "__main__":
    main()
