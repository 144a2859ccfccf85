"""What tests of compared designs share."""

from dataclasses import replace

from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest

import skinsource as ss
from skinsource.design.design import track
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource_gui.panels.compare.settings import CompareSettings

KEY, CTRL, ALT = Qt.Key, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.AltModifier
SHIFT = Qt.KeyboardModifier.ShiftModifier


def edit(window, amplitude):
    window.document.edit("a", window.document.design.with_input(0, amplitude=amplitude))


def levels(design):
    return ss.evaluate(design, "output_levels_db")["output_levels_db"]


def shown_levels(window):
    """What the skin map shows."""
    return window.panel("skin").map.content.values


def two_places(window):
    """Another place as well, louder than what there was."""
    design = window.document.design.adding(track(location=18, amplitude=3.0))
    window.document.edit("Place", design)


def show_matched(window, settle):
    """Store two snapshots, and show the second, made softer to match the first."""
    window.do("match_levels")
    window.do("store_snapshot_1")
    two_places(window)
    window.do("store_snapshot_2")
    for _ in range(2):
        window.do("toggle_snapshots")
        settle()


def cards(panel):
    return {card.number: card for card in panel.cards if not card.isHidden()}


def choose(window, **changes):
    view = window.document.view
    settings = replace(settings_of(view, "compare", CompareSettings), **changes)
    window.document.look(with_settings(view, "compare", settings))


def shown(panel, qtbot, n):
    """The maps, once there are ``n`` of the present design."""

    def complete():
        cells = panel.maps.content.cells
        drawn = [cell for cell in cells if cell.small is not None]
        return len(drawn) == n and not panel.maps.content.stale

    qtbot.waitUntil(complete, timeout=60_000)
    return panel.maps.content.cells


def point_at(maps, index, output):
    at = QPointF(*maps.points_of(index)[output - 1]).toPoint()
    QTest.mouseMove(maps, at)
    return at
