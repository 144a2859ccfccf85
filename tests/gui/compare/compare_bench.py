"""What tests of snapshots share."""

from PySide6.QtCore import Qt

import skinsource as ss
from skinsource.design.design import track

KEY, CTRL, ALT = Qt.Key, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.AltModifier


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
