"""Designs of files stand beside the present one; limbs of other axes show what they have."""

from dataclasses import replace

import pytest
from PySide6.QtWidgets import QFileDialog

from skinsource.design import edits
from skinsource.design.design import Design, track
from skinsource.design.design_file import save_design
from skinsource.design.panel_settings import with_settings
from skinsource.design.view import View
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.evaluation import evaluate
from skinsource_gui.panels.side_by_side.settings import SideBySideSettings
from tests.core.own_limbs.lab_bench import installed
from tests.gui.side_by_side.side_by_side_bench import shown

SAVED = Design(limb="synthetic-2", inputs=(track(13, Tone(frequency_hz=200.0), amplitude=3.0),))


@pytest.fixture
def panel(window, settle):
    settings = SideBySideSettings(of="snapshots")
    as_stored = replace(window.document.view, levels_matched=False)
    window.document.look(with_settings(as_stored, "side_by_side", settings))
    window.docks["side_by_side"].bring_forward()
    settle()
    return window.panel("side_by_side")


@pytest.fixture
def choose(monkeypatch, tmp_path):
    def choose(name):
        answer = str(tmp_path / name), ""
        monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: answer)

    return choose


def test_a_design_of_a_file_is_one_of_the_sides_and_the_present_one_stays_open(
    window, panel, qtbot, tmp_path, choose
):
    document = window.document
    save_design(tmp_path / "two hundred.skinsource", SAVED, View())
    choose("two hundred.skinsource")
    assert panel.bar.file.isVisible()
    assert not panel.bar.limbs.isVisible()
    before = document.design
    panel.bar.file.click()
    cells = shown(panel, qtbot, 2)
    assert document.design is before
    assert document.path is None
    assert {cell.heading for cell in cells} == {"Edited", "Snapshot 1 · two hundred"}
    [other] = [cell for cell in cells if cell.heading != "Edited"]
    expected = evaluate(SAVED, "output_levels_db", view=document.view)["output_levels_db"]
    assert other.values_db == pytest.approx(expected, abs=1e-9)
    # It is beside the history, as every snapshot.
    assert document.undo_stack.count() == 0
    # What cannot be read, and a fifth one, change nothing and say why.
    (tmp_path / "broken.skinsource").write_text("{")
    choose("broken.skinsource")
    window.do("take_snapshot")
    assert "broken.skinsource" in window.notice.text
    choose("two hundred.skinsource")
    for _ in range(4):
        window.do("take_snapshot")
    snapshots = document.view.snapshots
    assert [snapshot.number for snapshot in snapshots] == [1, 2, 3, 4]
    window.do("take_snapshot")
    assert "Forget one first" in window.notice.text
    assert document.view.snapshots == snapshots


def test_a_difference_of_snapshots_on_two_limbs_says_on_which_they_are(window, panel, qtbot):
    document = window.document
    document.apply(edits.take_snapshot(document.design, document.view, SAVED))
    settings = SideBySideSettings(of="snapshots", shown="difference")
    document.look(with_settings(document.view, "side_by_side", settings))
    [cell] = shown(panel, qtbot, 1)
    assert cell.headings[-1] == "1 on Synthetic 2 minus Edited on Synthetic 1"
    assert all(
        "on Synthetic 2" in heading and "on Synthetic 1" in heading for heading in cell.headings
    )


def test_a_snapshot_on_a_limb_without_the_axes_of_the_view_shows_those_it_has(
    window, panel, qtbot, user_data
):
    installed(axes="xz")
    window.limbs.look()
    document = window.document
    on_lab = Design(limb="lab-1", inputs=(track(3),))
    document.apply(edits.take_snapshot(document.design, document.view, on_lab))
    document.look(replace(document.view, axes="y"))
    cells = shown(panel, qtbot, 2)
    [lab] = [cell for cell in cells if cell.limb == "lab-1"]
    assert lab.heading == "Snapshot 1 (x, z)"
    view = View(axes="xz", method=document.view.method)
    expected = evaluate(on_lab, "output_levels_db", view=view)["output_levels_db"]
    assert lab.values_db == pytest.approx(expected, abs=1e-9)
