# SPDX-License-Identifier: BSD-3-Clause
"""The notebooks of the examples run from start to end, and are pages of the site."""

import pathlib

import pytest

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "examples" / "notebooks"


@pytest.mark.long
@pytest.mark.parametrize("path", sorted(FOLDER.glob("*.ipynb")), ids=lambda path: path.stem)
def test_notebook_runs_and_shows_what_it_holds(path):
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    kept = nbformat.read(path, as_version=4)
    run = nbformat.read(path, as_version=4)
    nbclient.NotebookClient(run, timeout=300, kernel_name="python3").execute()
    for before, after in zip(kept.cells, run.cells):
        if before.cell_type == "code":
            assert printed(after) == printed(before)


def test_every_notebook_is_a_page_of_the_site():
    navigation = (FOLDER.parents[1] / "mkdocs.yml").read_text()
    for path in FOLDER.glob("*.ipynb"):
        assert f"notebooks/{path.stem}.md\n" in navigation


def printed(cell):
    return "".join(output.text for output in cell.outputs if output.output_type == "stream" and output.name == "stdout")
