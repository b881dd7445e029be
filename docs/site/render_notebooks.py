#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pages of the site from notebooks: their text, code and kept results. Nothing is run; tests/python/test_notebooks.py does that.

usage: render_notebooks.py NOTEBOOK... FOLDER"""
import base64
import json
import pathlib
import shutil
import sys


def write_result(result, folder, name):
    """Markdown of a result of a cell: a picture with the lines above it, else the text."""
    data = result.get("data", {})
    if "image/png" in data:
        (folder / name).write_bytes(base64.b64decode("".join(data["image/png"])))
        lines = "".join(data.get("text/html", "")).partition("<br><img")[0]
        return f"{lines}\n\n![{''.join(data['text/plain'])}]({name})"
    text = "".join(data.get("text/plain") or result.get("text", ""))
    return f"```text\n{text.rstrip()}\n```" if text else ""


def list_parts(notebook, folder, name):
    number = 0
    for cell in notebook["cells"]:
        source = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            yield source
            continue
        yield f"```python\n{source}\n```"
        streams = [result for result in cell["outputs"] if result["output_type"] == "stream"]
        if streams:  # one after the other, as they were printed
            yield write_result({"text": "".join("".join(result["text"]) for result in streams)}, folder, "")
        for result in [result for result in cell["outputs"] if result not in streams]:
            number += 1
            yield write_result(result, folder, f"{name}_{number}.png")


def main():
    *paths, folder = map(pathlib.Path, sys.argv[1:])
    folder.mkdir(parents=True, exist_ok=True)
    for path in paths:
        title, _, rest = "\n\n".join(list_parts(json.loads(path.read_text()), folder, path.stem)).partition("\n")
        link = f"This page is a notebook: [download {path.name}]({path.name})."
        (folder / f"{path.stem}.md").write_text(f"{title}\n\n{link}\n{rest}\n")
        shutil.copy(path, folder)


if __name__ == "__main__":
    main()
