"""Snapshots that cannot be predicted yet, or that are silent."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QEvent
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QApplication

from skinsource.design.comparing import Snapshot
from skinsource.design.design import Design, track
from skinsource_gui.panels.compare.card import equal_captions, matching_text
from skinsource_gui.plots.colour_maps import colour_table
from skinsource_gui.state.compared import SILENCE, Compared, is_silent


@pytest.fixture
def panel(window, settle):
    window.docks["compare"].bring_forward()
    settle()
    return window.panel("compare")


def card(panel, number):
    return next(card for card in panel.cards if card.number == number)


def test_a_snapshot_on_a_limb_that_was_missing_is_predicted_once_it_is_installed(
    window, settle, panel, qtbot, synthetic_installed
):
    away = synthetic_installed.with_suffix(".away")
    synthetic_installed.rename(away)
    start = window.document.design
    window.document.edit("a", Design(limb="measured-2", inputs=(track(7),)))
    window.do("store_snapshot_1")
    window.document.edit("b", start)
    settle()
    qtbot.waitUntil(lambda: bool(card(panel, 1).compared.problem))
    away.rename(synthetic_installed)
    QApplication.sendEvent(window, QEvent(QEvent.Type.WindowActivate))
    settle()
    qtbot.waitUntil(lambda: card(panel, 1).compared.problem == "", timeout=5000)
    assert card(panel, 1).compared.values is not None


def test_what_cannot_be_predicted_is_not_said_to_be_as_loud(window, settle, panel):
    here = window.document.design
    window.do("match_levels")
    window.do("store_snapshot_2")
    window.document.edit("a", replace(here, inputs=(track(18),)))
    window.do("store_snapshot_3")
    window.document.edit("b", Design(limb="measured-2", inputs=(track(7),)))
    window.do("store_snapshot_1")
    settle()
    assert (
        panel.text_label.text() == "Snapshot 1 cannot be predicted: levels cannot be matched to it"
    )


def test_what_is_silent_is_not_said_to_be_as_loud(window, settle, panel):
    window.do("match_levels")
    window.document.edit("a", Design(limb="synthetic-1"))
    window.do("store_snapshot_1")
    window.document.edit("b", Design(limb="synthetic-1", inputs=(track(7),)))
    window.do("store_snapshot_2")
    settle()
    text = panel.text_label.text()
    assert "sil " not in text
    assert text == "Snapshot 1 is silent: levels cannot be matched to it"
    # 60 dB below the other one, as if that were its level, would be said of it.
    assert panel.map.difference.shown is None
    assert panel.map.difference.text == SILENCE
    assert matching_text((), matched=True) == ""
    # Nor is what sounds 60 dB above the one that is silent.
    window.do("toggle_snapshots")
    settle()
    assert window.document.design.inputs == ()
    assert (panel.map.difference.shown, panel.map.difference.text) == (None, SILENCE)
    # Two that are silent are alike.
    window.do("store_snapshot_2")
    settle()
    assert panel.map.difference.text != SILENCE


def test_a_silent_snapshot_has_no_colours(window, settle, panel):
    window.document.edit("a", Design(limb="synthetic-1"))
    window.do("store_snapshot_1")
    settle()
    panel_card = card(panel, 1)
    assert is_silent(panel_card.compared)
    panel_card.resize(140, 200)
    lowest = colour_table(panel_card._scale.colours)[0]
    lowest = QColor(int(lowest)).rgb()
    picture = panel_card.grab().toImage()
    colours = {
        picture.pixel(x, y)
        for x in range(0, picture.width(), 2)
        for y in range(picture.height() // 4, picture.height() * 3 // 4)
    }
    assert lowest not in colours


def test_the_largest_amplitude_is_compared_with_what_is_matched_to_it():
    loud, soft = (
        Design(limb="synthetic-1", inputs=(track(7, amplitude=size),)) for size in (1000.0, 500.0)
    )
    first, second = Snapshot(number=1, design=loud), Snapshot(number=2, design=soft)
    for gains in ((2.0, 4.0), (0.5, 1.0)):
        sides = [
            Compared(snapshot=side, gain=gain)
            for side, gain in zip((first, second), gains, strict=True)
        ]
        assert "once levels match" in equal_captions(*sides)[1]
        assert "once levels match" in equal_captions(*sides[::-1])[1]
