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


def run(path, folder):
    """Run a notebook in a kernel of its own; give its code cells with their outputs."""
    notebook = nbformat.read(path, as_version=4)
    client = nbclient.NotebookClient(
        notebook, timeout=120, kernel_name="python3", resources={"metadata": {"path": str(folder)}}
    )
    client.execute()
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def kinds_of(cell):
    return {kind for output in cell.outputs for kind in output.get("data", {})}


def test_there_are_three_and_figure_2_takes_ten_cells():
    assert [path.stem for path in NOTEBOOKS] == ["figure_2", "people", "sweep"]
    assert len(cells_of(NOTEBOOKS[0])) == 10


@every
def test_no_output_is_kept(path):
    for cell in cells_of(path):
        assert cell.outputs == []
        assert cell.execution_count is None


@every
def test_each_runs_on_the_synthetic_limbs_and_shows_designs_and_pictures(path, tmp_path, user_data):
    cells = run(path, tmp_path)
    shown = set().union(*map(kinds_of, cells))
    assert "text/plain" in shown
    text = "".join(
        output.get("text", "") for cell in cells for output in cell.outputs if "text" in output
    )
    if path.stem == "sweep":
        assert (tmp_path / "reach.png").read_bytes().startswith(b"\x89PNG")
        assert "reaches farthest" in text
    else:
        assert {"text/html", "image/png"} <= shown
    if path.stem == "figure_2":
        assert "SYNTHETIC" in text
