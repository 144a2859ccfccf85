"""The example notebooks run, and hold nothing but what was written."""

from pathlib import Path

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")

NOTEBOOKS = sorted((Path(__file__).parents[2] / "examples").glob("*.ipynb"))
every = pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)


def cells_of(path):
    notebook = nbformat.read(path, as_version=4)
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def test_there_are_three_and_figure_2_takes_ten_cells():
    assert [path.stem for path in NOTEBOOKS] == ["figure_2", "people", "sweep"]
    assert len(cells_of(NOTEBOOKS[0])) == 10


@every
def test_no_output_is_kept(path):
    for cell in cells_of(path):
        assert cell.outputs == []
        assert cell.execution_count is None


def test_they_run_on_the_synthetic_limbs_and_show_designs_and_pictures(tmp_path, user_data):
    """One after the other in one kernel, which forgets in between."""
    notebooks = {path.stem: nbformat.read(path, as_version=4) for path in NOTEBOOKS}
    together = nbformat.v4.new_notebook()
    for notebook in notebooks.values():
        together.cells += [nbformat.v4.new_code_cell("%reset -f"), *notebook.cells]
    resources = {"metadata": {"path": str(tmp_path)}}
    nbclient.NotebookClient(together, timeout=120, resources=resources).execute()
    for name, notebook in notebooks.items():
        outputs = [output for cell in notebook.cells for output in cell.get("outputs", ())]
        kinds = {kind for output in outputs for kind in output.get("data", {})}
        text = "".join(output.get("text", "") for output in outputs)
        assert "text/plain" in kinds
        if name == "sweep":
            assert (tmp_path / "reach.png").read_bytes().startswith(b"\x89PNG")
            assert "reaches farthest" in text
        else:
            assert {"text/html", "image/png"} <= kinds
        if name == "figure_2":
            assert "SYNTHETIC" in text
