"""The Analysis panel: its chooser, two of them beside each other, and pictures of other views."""

from dataclasses import replace

import pytest
from PySide6.QtWidgets import QApplication

from skinsource.design.panel_settings import settings_of
from skinsource_gui.panels.analysis.settings import VIEWS, AnalysisSettings
from skinsource_gui.plots.pictures import save_drawing
from tests.gui.analysis.analysis_bench import analysis


@pytest.fixture
def window(open_window, settle_on):
    window = open_window()
    window.document.look(replace(window.document.view, outputs=(20, 26)))
    settle_on(window)
    return window


@pytest.fixture
def settle_on(qtbot):
    def settle(window):
        qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)
        QApplication.processEvents()

    return settle


def test_what_is_chosen_is_shown_with_what_it_answers_and_saved(window, settle_on):
    analysis(window, "statistics")
    panel = window.panel("analysis")
    for spec in VIEWS:
        panel.choice.choose(spec.name)
        settle_on(window)
        assert settings_of(window.document.view, "analysis", AnalysisSettings).shown == spec.name
        assert (panel.view.name, panel.view.title) == (spec.name, spec.title)
        assert panel.answer.text == spec.answer
        assert [view.isVisible() for view in panel._views.values()].count(True) == 1
        assert panel.copy.isVisible() == panel.view.copies
        assert not panel.view.is_stale
    # What was chosen before shows the present design when it is chosen again.
    panel.choice.choose("statistics")
    settle_on(window)
    before = panel.view.rows
    panel.choice.choose("regions")
    window.document.edit("Louder", window.document.design.with_input(0, amplitude=5.0))
    settle_on(window)
    panel.choice.choose("statistics")
    settle_on(window)
    assert panel.view.rows[0].values[0] == pytest.approx(5.0 * before[0].values[0])
    assert panel.copy.isEnabled()
    # What an audience is to guess is covered in each view that is chosen.
    panel.show_covered(True)
    panel.choice.choose("windowed")
    assert panel.view._covers
    panel.show_covered(False)
    assert not panel.view._covers


def test_a_second_one_beside_the_first_shows_another_view_or_the_same(window, settle_on):
    window.do("arrange_analysis")
    first = analysis(window, "statistics")
    second = analysis(window, "main_axis", "analysis_2")
    settle_on(window)
    assert first.isVisible()
    assert second.isVisible()
    assert first.rows
    assert second.message == ""
    panel = window.panel("analysis_2")
    panel.choice.choose("statistics")
    settle_on(window)
    assert window.panel("analysis").view is first
    assert [row.values for row in panel.view.rows] == [row.values for row in first.rows]
    assert not panel.view.is_stale


@pytest.mark.parametrize("visible", [True, False])
def test_a_picture_of_another_view_leaves_the_chosen_one(window, settle_on, tmp_path, visible):
    panel, shown = window.panel("analysis"), analysis(window, "statistics")
    window.docks["analysis"].setVisible(visible)
    settle_on(window)
    picture = window.pictures.picture_of("analysis/windowed")
    save_drawing(tmp_path / "a.svg", picture.draw, 900, 700)
    text = (tmp_path / "a.svg").read_text("utf-8")
    assert " in windows" in text
    assert (panel.view, panel.choice.value) == (shown, "statistics")
    window.docks["analysis"].bring_forward()
    settle_on(window)
    assert shown.rows
    assert not shown.is_stale
