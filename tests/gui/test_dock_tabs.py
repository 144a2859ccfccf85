"""Panels that share a place: one in front, the others as tabs."""

import random

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from skinsource.design.design_file import save_design
from skinsource.design.view import View
from skinsource.limbs.catalog import available_limbs
from skinsource_gui.shell.arrangement_spec import ARRANGEMENTS, Behind, Place
from skinsource_gui.shell.panels import PANELS
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import start_design
from tests.gui.dock_bench import bar_with, bars, click_tab, in_sight, titles


@pytest.fixture
def requested(window):
    """What the window was last asked for."""
    requests = []
    window.conductor.delivered.connect(lambda outcome: requests.append(outcome.request.wanted))
    return lambda: requests[-1]


def test_every_panel_comes_up_in_every_arrangement_and_squeezes_none(window, settle):
    for arrangement in ARRANGEMENTS:
        window.do(f"arrange_{arrangement.name}")
        settle()
        sizes = {name: window.docks[name].width() for name in in_sight(window)}
        for spec in PANELS:
            name = spec.panel.name
            window.docks[name].bring_forward()
            settle()
            assert name in in_sight(window)
            place = spec.places[arrangement.name]
            if not isinstance(place, Place):
                host = place.panel if isinstance(place, Behind) else arrangement.host
                assert window.docks[host] in window.tabifiedDockWidgets(window.docks[name])
        for name in sizes:
            window.docks[name].bring_forward()
        settle()
        assert {name: window.docks[name].width() for name in sizes} == sizes


def test_nothing_is_computed_for_a_panel_behind_another_one(window, settle, requested):
    window.tabifyDockWidget(window.docks["traces"], window.docks["spectra"])
    settle()
    click_tab(window, "Traces")
    others = (panel.needs for panel in window.panels if panel.name != "spectra")
    own = window.panel("spectra").needs.difference(*others)
    assert own
    window.document.edit("a", window.document.design.with_input(0, amplitude=2.0))
    settle()
    assert "selected_traces" in requested()
    assert not requested() & own
    click_tab(window, "Spectra")
    settle()
    assert requested() >= own
    window.document.edit("b", window.document.design.with_input(0, amplitude=3.0))
    settle()
    assert "selected_traces" not in requested()


def test_a_panel_that_comes_to_the_front_shows_the_present_design(window, settle):
    window.tabifyDockWidget(window.docks["traces"], window.docks["spectra"])
    click_tab(window, "Spectra")
    window.do("clear_inputs")
    settle()
    drawn = []
    window.panel("traces").show_results = drawn.append
    window.panel("traces").show_problem = drawn.append
    window.do("undo")
    settle()
    assert not drawn
    click_tab(window, "Traces")
    settle()
    assert len(drawn) == 1


def test_snapshots_are_not_predicted_for_a_comparison_behind_another_panel(window, settle):
    window.docks["compare"].bring_forward()
    settle()
    click_tab(window, "Inspector")
    deliveries = []
    window.panel("compare").show_snapshots = deliveries.append
    window.do("store_snapshot_1")
    window.document.edit("a", window.document.design.with_input(0, amplitude=2.0))
    settle()
    assert not deliveries


def test_tabs_of_the_last_session_are_tabs_again(qtbot, preferences):
    def session():
        window = MainWindow(
            start_design("synthetic-1"), preferences=preferences, available_limbs=available_limbs()
        )
        qtbot.addWidget(window, before_close_func=lambda window: window.runner.close())
        window.show()
        qtbot.waitExposed(window)
        qtbot.waitUntil(lambda: not window.engine.busy)
        return window

    first = session()
    first.docks["history"].bring_forward()
    first.docks["library"].bring_forward()
    QApplication.processEvents()
    first.splitDockWidget(first.docks["spectra"], first.docks["compare"], Qt.Orientation.Vertical)
    first.docks["compare"].show()
    before = in_sight(first)
    assert {"library", "compare"} <= before
    assert not {"history", "inspector"} & before
    first.close()
    again = session()
    QApplication.processEvents()
    assert in_sight(again) == before
    assert sorted(titles(bar_with(again, "Library"))) == ["History", "Inspector", "Library"]
    requests = []
    again.conductor.delivered.connect(lambda outcome: requests.append(outcome.request.wanted))
    click_tab(again, "Inspector")
    assert "inspector" in in_sight(again)


def test_a_file_brings_its_panel_to_the_front(window, settle, tmp_path):
    path = tmp_path / "behind.skinsource"
    window.docks["library"].bring_forward()
    settle()
    save_design(path, window.document.design, View(), layout=window.layout_of_docks.content())
    window.do("arrange_design")
    settle()
    assert "inspector" in in_sight(window)
    window.files.open(path)
    settle()
    assert "library" in in_sight(window)
    assert "inspector" not in in_sight(window)
    assert not window.docks["inspector"].isHidden()


@pytest.mark.parametrize("seed", range(2))
def test_whatever_is_done_to_docks_just_those_in_front_are_shown(window, settle, seed):
    chance = random.Random(seed)  # noqa: S311
    docks = list(window.docks.values())
    saved = [window.saveState()]

    def act():
        dock, other = chance.sample(docks, 2)
        way = chance.choice(list(Qt.Orientation))
        arrangement = chance.choice(ARRANGEMENTS).name
        chance.choice(
            [
                lambda: window.tabifyDockWidget(dock, other),
                lambda: window.splitDockWidget(dock, other, way),
                lambda: dock.setFloating(not dock.isFloating()),
                dock.hide,
                dock.show,
                dock.raise_,
                dock.bring_forward,
                lambda: window.arrangements.show(arrangement),
                lambda: saved.append(window.saveState()),
                lambda: window.restoreState(chance.choice(saved)),
                lambda: window.layout_of_docks.show_panels(chance.choice(saved).data()),
            ]
        )()

    for _ in range(40):
        act()
        shared_bars = [bar for bar in bars(window) if bar.count() > 1]
        for dock in docks:
            visible = dock.isFloating() or not dock.visibleRegion().isEmpty()
            assert dock.panel.isVisible() == (dock.isVisible() and visible), dock.objectName()
        assert all(bar.focusPolicy() == Qt.FocusPolicy.NoFocus for bar in shared_bars)
    settle()
