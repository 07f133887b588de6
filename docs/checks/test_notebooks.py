"""Notebooks of tutorials can be downloaded as they ran."""

import json

import nbformat
import pytest
from nbclient.exceptions import CellExecutionError
from notebooks import run_notebook
from test_site import SITE, page

TUTORIALS = sorted((SITE / "generated" / "tutorials").glob("plot_*.html"))


def made(path, *code):
    cells = [nbformat.v4.new_code_cell(text) for text in code]
    nbformat.write(nbformat.v4.new_notebook(cells=cells), path)
    return path


def printed(path):
    return [cell.outputs for cell in nbformat.read(path, as_version=4).cells]


def test_there_are_tutorials():
    assert len(TUTORIALS) >= 5


@pytest.mark.parametrize("tutorial", TUTORIALS, ids=lambda path: path.stem)
def test_every_tutorial_offers_its_notebook_with_numbers_and_pictures(tutorial):
    links = page(tutorial.relative_to(SITE).as_posix()).links
    (link,) = {link for link in links if link.endswith(".ipynb")}
    text = (tutorial.parent / link).read_text(encoding="utf-8")
    code = [cell for cell in json.loads(text)["cells"] if cell["cell_type"] == "code"]
    assert [cell["execution_count"] for cell in code] == [*range(1, len(code) + 1)]
    outputs = [output for cell in code for output in cell["outputs"]]
    kinds = {output["output_type"] for output in outputs}
    assert "error" not in kinds
    assert any("image/png" in output.get("data", {}) for output in outputs)
    assert kinds & {"stream", "execute_result"}


def test_a_notebook_runs_once_in_the_folder_given(tmp_path):
    path = made(tmp_path / "note.ipynb", "from pathlib import Path\nPath('a').touch(); print(2)")
    folder = tmp_path / "there"
    folder.mkdir()
    run_notebook(path, folder)
    assert (folder / "a").exists()
    ((output,),) = printed(path)
    assert output.text == "2\n"
    (folder / "a").unlink()
    run_notebook(path, folder)
    assert not (folder / "a").exists()


def test_a_cell_that_fails_fails_the_build(tmp_path):
    with pytest.raises(CellExecutionError, match="division by zero"):
        run_notebook(made(tmp_path / "note.ipynb", "1 / 0"), tmp_path)


def test_what_is_drawn_stands_below_its_cell_whatever_the_gallery_draws_with(tmp_path, monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "agg")
    code = "import matplotlib.pyplot as plt\nplt.plot([1, 2])\nplt.show()"
    path = made(tmp_path / "note.ipynb", code)
    run_notebook(path, tmp_path)
    ((*_, output),) = printed(path)
    assert "image/png" in output.data
