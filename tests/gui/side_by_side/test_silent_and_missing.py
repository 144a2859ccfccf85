"""Sides that are silent, or cannot be predicted, and a design that is shown with a gain."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource.design.design import Design, track
from skinsource_gui.panels.side_by_side.content import tab_separated
from skinsource_gui.state.compared import SILENCE
from tests.gui.compare.compare_bench import levels, show_matched, two_places
from tests.gui.side_by_side.side_by_side_bench import choose as choose_sides


@pytest.fixture
def choose(window, settle):
    """Choose what stands side by side; return the panel."""
    window.docks["side_by_side"].bring_forward()

    def chosen(**changes):
        choose_sides(window, **changes)
        settle()
        return window.panel("side_by_side")

    return chosen


@pytest.fixture
def one_silent(window, settle):
    """Two snapshots that sound; what is edited does not."""
    window.do("store_snapshot_1")
    two_places(window)
    window.do("store_snapshot_2")
    window.document.edit("Remove all", Design(limb="synthetic-1"))
    settle()
    return [snapshot.design for snapshot in window.document.view.snapshots]


def test_between_silence_and_sound_there_is_no_difference(choose, one_silent):
    panel = choose(of="snapshots", shown="difference")
    assert [cell.text for cell in panel.maps.content.cells] == [SILENCE, SILENCE]
    assert all(cell.small is None for cell in panel.maps.content.cells)


@pytest.mark.parametrize("own", [False, True])
def test_silence_is_called_so_and_copied_as_nothing(choose, one_silent, own):
    content = choose(of="snapshots", shown="levels", own_maximum=own).maps.content
    silent, first, second = sorted(content.cells, key=lambda cell: cell.values_db.max())
    assert silent.maximum_db is None
    assert (first.maximum_db is not None) is own
    assert silent.value_text(None) == silent.value_text(3) == "silent"
    readout = content.readout(3).rpartition(": ")[2]
    level_texts = (first.value_text(3), second.value_text(3))
    readout = readout.removesuffix(" re each map's maximum")
    assert set(readout.split(" · ")) == {"silent", *level_texts}
    place = 1 + content.cells.index(silent)
    rows = [line.split("\t") for line in tab_separated(content).splitlines()[1:]]
    assert {row[place] for row in rows} == {""}
    assert all(number for row in rows for k, number in enumerate(row) if k != place)


def test_silence_is_no_level_that_a_mean_is_over(choose, one_silent):
    mean, spread = choose(of="snapshots", shown="mean").maps.content.cells
    levels_db = np.array([levels(levels_of) for levels_of in one_silent])
    levels_db = np.maximum(levels_db, levels_db.max() - 60.0)
    np.testing.assert_allclose(mean.values_db, levels_db.mean(axis=0), atol=1e-9)
    np.testing.assert_allclose(spread.values_db, levels_db.std(axis=0, ddof=1), atol=1e-9)
    assert mean.headings[-2] == "Mean of 2 of 3"


def test_what_is_matched_to_silence_is_not_said_to_be_matched(choose, one_silent, window, settle):
    assert "matched" not in choose(of="snapshots", shown="levels").maps.content.about
    window.docks["regions"].bring_forward()
    settle()
    assert "matched" not in window.panel("regions").about.text


def test_a_limb_that_is_not_here_is_the_reason_that_is_given(choose, window, settle):
    window.do("store_snapshot_1")
    window.document.edit("Limb", Design(limb="lab-nowhere", inputs=(track(7),)))
    settle()
    assert "lab-nowhere" in choose(of="limbs").maps.content.message
    (cell,) = choose(of="snapshots", shown="difference").maps.content.cells
    assert "lab-nowhere" in cell.text
    assert "is not available" in cell.text
    (cell,) = choose(of="snapshots", shown="mean").maps.content.cells
    assert "is not available" in cell.text


def test_a_design_that_is_shown_with_a_gain_has_it_on_every_limb_and_axis(choose, window, settle):
    show_matched(window, settle)
    design = window.document.design
    gain_db = 20 * np.log10(window.document.view.match_gain(design))
    panel = choose(of="limbs", shown="levels")
    for number, cell in enumerate(panel.maps.content.cells, 1):
        stored = levels(replace(design, limb=f"synthetic-{number}"))
        np.testing.assert_allclose(cell.values_db, stored + gain_db, atol=1e-9)
    gain_text = f"{gain_db:.1f} dB, matched".replace("-", "\N{MINUS SIGN}")
    for content in (panel.maps.content, choose(of="axes").maps.content):
        assert content.common_scale.text_below == f"dB re 1 m/s², {gain_text}"
    window.docks["regions"].bring_forward()
    settle()
    assert f"people: {gain_text}" in window.panel("regions").about.text
