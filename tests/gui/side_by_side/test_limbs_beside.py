"""Limbs side by side: which of them are chosen, and those that cannot be predicted."""

from skinsource.design.design import track
from skinsource_gui.state.engine import Purpose
from tests.core.own_limbs.lab_bench import installed
from tests.gui.side_by_side.side_by_side_bench import choose, shown


def test_two_to_four_limbs_are_chosen_from_those_there_are(window, panel, qtbot):
    shown(panel, qtbot, 4)

    def entries():
        panel.bar.limbs.fill()
        return {
            action.text(): action
            for action in panel.bar.limbs.menu_of_limbs.actions()
            if action.text()
        }

    offered = entries()
    assert offered["Those that belong together"].isChecked()
    offered["Synthetic 2 (165 mm)"].trigger()
    assert len(shown(panel, qtbot, 3)) == 3
    entries()["Synthetic 4 (165 mm)"].trigger()
    cells = shown(panel, qtbot, 2)
    assert [cell.limb for cell in cells] == ["synthetic-1", "synthetic-3"]
    offered = entries()
    assert not offered["Synthetic 3 (185 mm)"].isEnabled()
    assert offered["Synthetic 4 (165 mm)"].isEnabled()
    assert not offered["Those that belong together"].isChecked()
    offered["Those that belong together"].trigger()
    shown(panel, qtbot, 4)


def test_a_limb_that_is_too_large_missing_or_otherwise_laid_out_says_so_and_runs_not(
    window, panel, qtbot, settle, monkeypatch
):
    choose(window, limbs="synthetic-1 synthetic-2 lab-1")
    shown(panel, qtbot, 2)
    assert "No limb is called 'lab-1'" in panel.maps.content.cells[2].text
    document = window.document
    document.edit("a", document.design.with_input(0, location=3).adding(track(2)))
    installed()
    window.limbs.look()
    cells = shown(panel, qtbot, 3)
    assert cells[2].heading == "Lab 1 (x, z)"
    assert cells[2].values_db.shape == (31,)
    choose(window, shown="difference")
    shown(panel, qtbot, 1)
    assert "other places" in panel.maps.content.cells[1].text
    choose(window, shown="mean")
    assert shown(panel, qtbot, 2)[0].heading == "Mean of 2 of 3: Synthetic 1, Synthetic 2"
    monkeypatch.setattr("skinsource.limbs.limb.LIVE_INPUTS", 5)
    monkeypatch.setattr("skinsource_gui.state.engine.LIVE_INPUTS", 5)
    asked = []
    ask = window.engine.request
    monkeypatch.setattr(
        window.engine, "request", lambda request: (asked.append(request), ask(request))
    )
    choose(window, shown="levels")
    document.edit("b", document.design.with_input(0, amplitude=0.3))
    settle()
    # Published limbs are larger than that as well.
    qtbot.waitUntil(
        lambda: all("follow edits up to 5" in cell.text for cell in panel.maps.content.cells)
    )
    choose(window, of="snapshots")
    window.do("store_snapshot_1")
    document.edit("c", document.design.with_input(0, amplitude=0.2))
    settle()
    # Lamps and error of what was shown before may still be on their way.
    quantities = [request.wanted for request in asked if request.purpose == Purpose.SHOW]
    # What clips play is drawn all the same, and runs through no limb.
    assert not any("output_levels_db" in names or "vibration" in names for names in quantities)
    assert all("follow edits up to 5" in cell.text for cell in panel.maps.content.cells)
