"""Each map in its own scale: a switch that is remembered, says so, and computes nothing."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest

from skinsource.base.decibels import FLOOR_DB
from skinsource.design.panel_settings import settings_of
from skinsource.signals.map_range import MAP_RANGE_DB
from skinsource_gui.panels.side_by_side.content import Cells
from skinsource_gui.panels.side_by_side.settings import SideBySideSettings
from skinsource_gui.panels.skin.settings import SkinSettings
from tests.gui.side_by_side.test_side_by_side import choose, point_at, shown

OWN = "dB re each map's maximum"


@pytest.fixture
def panel(window, settle):
    window.docks["side_by_side"].bring_forward()
    settle()
    return window.panel("side_by_side")


def switch(panel):
    QTest.mouseClick(panel.bar.own_maximum, Qt.MouseButton.LeftButton)


def test_all_share_a_scale_until_each_is_drawn_to_its_maximum(window, panel, qtbot):
    before = [cell.values_db for cell in shown(panel, qtbot, 4)]
    assert panel.maps.content.common_scale.text_below == "dB re 1 m/s²"
    switch(panel)
    assert settings_of(window.document.view, "side_by_side", SideBySideSettings).own_maximum
    assert panel.bar.own_maximum.isChecked()
    cells = shown(panel, qtbot, 4)
    assert panel.maps.content.common_scale.text_below == OWN
    assert panel.maps.content.common_scale.range_db == (-MAP_RANGE_DB, 0.0)
    for cell, values in zip(cells, before, strict=True):
        assert cell.values_db == pytest.approx(values - values.max(), abs=1e-12)
        assert np.nanmax(cell.small.field_levels_db) == pytest.approx(0.0, abs=1.0)
        assert cell.value_text(None).startswith(f"max {values.max():.1f} dB".replace("-", "−"))
    switch(panel)
    for cell, values in zip(shown(panel, qtbot, 4), before, strict=True):
        assert cell.values_db == pytest.approx(values, abs=1e-12)


def test_the_switch_computes_nothing(window, panel, qtbot, settle):
    shown(panel, qtbot, 4)
    before = [values.values for values in panel._compared]
    asked = []
    ask = window.engine.request
    window.engine.request = lambda request: (asked.append(request.slot.name), ask(request))
    for _ in range(2):
        switch(panel)
        settle()
        now = [values.values for values in panel._compared]
        assert all(values is other for values, other in zip(before, now, strict=True))
    assert not any("limb" in request for request in asked)


def test_readings_and_copies_say_what_levels_are_relative_to(window, panel, qtbot):
    before = [cell.values_db for cell in shown(panel, qtbot, 4)]
    switch(panel)
    point_at(panel.maps, 1, 23)
    assert panel.text_label.text.endswith(" dB re each map's maximum")
    panel.copy.click()
    head, *rows = QGuiApplication.clipboard().text().splitlines()
    for column, values in enumerate(before, 1):
        title, below = head.split("\t")[column], float(rows[22].split("\t")[column])
        assert below == pytest.approx(values[22] - values.max())
        maximum = float(title.split(" of ")[1].split(" dB")[0])
        assert maximum == pytest.approx(values.max())


def test_what_is_silent_stays_so(window, panel, qtbot):
    choose(window, of="axes", own_maximum=True)
    shown(panel, qtbot, 3)
    document = window.document
    document.edit("Silent", document.design.with_input(0, amplitude=0.0))
    qtbot.waitUntil(
        lambda: not any(cell.small for cell in panel.maps.content.cells), timeout=10_000
    )
    assert panel.maps.content.message.startswith("Silent")


def test_an_output_that_is_silent_is_no_level_below_the_maximum(panel, qtbot):
    shown(panel, qtbot, 4)
    compared = panel._compared[0]
    levels = compared.values["output_levels_db"].copy()
    levels[2] = FLOOR_DB
    silent = replace(compared, values={**compared.values, "output_levels_db": levels})
    (cell,) = Cells().of_own_maxima([silent], [("a limb",)])
    assert cell.value_text(3) == "silent"
    assert cell.value_text(4) != "silent"


def test_a_range_that_was_fixed_is_that_of_the_shared_scale(window, panel, qtbot):
    shown(panel, qtbot, 4)
    view = window.document.view
    from skinsource.design.panel_settings import with_settings

    fixed = replace(settings_of(view, "skin", SkinSettings), map_range_db=(-30.0, -10.0))
    window.document.look(with_settings(view, "skin", fixed))
    assert shown(panel, qtbot, 4)[0].scale.range_db == (-30.0, -10.0)
    switch(panel)
    assert shown(panel, qtbot, 4)[0].scale.range_db == (-MAP_RANGE_DB, 0.0)


def test_only_levels_have_maxima_of_their_own(window, panel, qtbot):
    shown(panel, qtbot, 4)
    switch(panel)
    for what, n in (("difference", 3), ("mean", 2)):
        choose(window, shown=what)
        cells = shown(panel, qtbot, n)
        assert not panel.bar.own_maximum.isVisible()
        assert all(cell.maximum_db is None for cell in cells)
    # Of axes these are shown whatever was chosen of others.
    choose(window, of="axes")
    assert shown(panel, qtbot, 3)[0].maximum_db is not None
    assert panel.bar.own_maximum.isVisible()


@pytest.mark.parametrize(("name", "n"), [("1F", 3), ("1G", 4)])
def test_scenes_whose_figures_have_a_scale_for_each_map_open_so(window, qtbot, settle, name, n):
    window.scenes.open(name)
    settle()
    panel = window.panel("side_by_side")
    shown(panel, qtbot, n)
    assert panel.maps.content.common_scale.text_below == OWN
    assert "scale" not in window.document.design.notes
