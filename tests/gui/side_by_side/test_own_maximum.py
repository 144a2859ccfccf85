"""Each map in its own scale: a switch that is remembered, says so, and computes nothing."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest

from skinsource.design.panel_settings import settings_of
from skinsource.signals.map_range import MAP_RANGE_DB
from skinsource_gui.panels.side_by_side.settings import SideBySideSettings
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
