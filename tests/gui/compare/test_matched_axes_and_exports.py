"""While levels of snapshots are matched every axis says so, and nothing that is exported has it."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import QApplication, QFileDialog

from skinsource.design.comparing import match_text
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource_gui.panels.skin.scale import fitting_title
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.plots.pictures import ALL_VISIBLE, drawn_image
from skinsource_gui.shell.status import MatchNote
from tests.gui.compare.compare_bench import levels, show_matched, shown_levels

OUTPUTS = (20, 33, 29)
DRAWN = ("skin", "traces", "spectra", "compare", "spectrogram", "wave", "windowed", "side_by_side")


@pytest.fixture
def open_window(make_window):
    """Each test has a window of its own."""
    return make_window


@pytest.fixture
def gain_text(window, settle, monkeypatch):
    """Show the second of two snapshots, made softer to match the first; by how much, in words."""
    # It takes room from the panels, whose pictures are as wide and high as they are.
    monkeypatch.setattr(MatchNote, "setVisible", lambda *_: None)
    document = window.document
    document.look(replace(document.view, outputs=OUTPUTS))
    show_matched(window, settle)
    gain = document.view.match_gain(document.design)
    assert gain < 0.9
    text = match_text(gain)
    assert text == f"\N{MINUS SIGN}{-20 * np.log10(gain):.1f} dB, matched"
    return text


def brought_forward(window, settle, name):
    window.docks[name].bring_forward()
    settle()
    return window.panel(name)


def test_every_axis_says_by_how_much(window, settle, gain_text):
    for name in ("traces", "spectra"):
        plot = brought_forward(window, settle, name)._plot.plot
        assert plot.places.header.unit.endswith(f", {gain_text}"), name
        # Whatever else gives way to a note.
        metrics = QFontMetrics(plot.font())
        assert gain_text in plot.places.header.fitted(metrics, 1.0)[0], name
    assert brought_forward(window, settle, "windowed").strip.content.scale.text_below.endswith(
        gain_text
    )
    spectrogram = brought_forward(window, settle, "spectrogram").picture
    assert spectrogram.content.matched == gain_text
    wave = brought_forward(window, settle, "wave").picture
    wave.grab()
    assert wave._diagrams[1][0].y.title.endswith(f", {gain_text}")
    for name in ("statistics", "perception"):
        panel = brought_forward(window, settle, name)
        assert gain_text in (panel.about.text if name == "statistics" else panel.limits.text())


@pytest.mark.parametrize("quantity", ["levels", "sensation", "z", "magnitude", "rms"])
def test_the_colour_bar_of_the_map_says_it_whatever_it_shows(window, settle, gain_text, quantity):
    document = window.document
    settings = replace(settings_of(document.view, "skin", SkinSettings), quantity=quantity)
    document.look(with_settings(document.view, "skin", settings))
    settle()
    panel = window.panel("skin")
    shown = panel.map.content.quantity
    assert (shown.name, shown.matched) == (quantity, gain_text)
    assert all(gain_text in title for title in shown.titles)
    metrics = QFontMetrics(panel.font())
    assert fitting_title(shown, metrics, metrics.horizontalAdvance(gain_text)) == gain_text
    if quantity == "z":
        assert panel.time.bar.strip._matched == gain_text


@pytest.mark.parametrize("name", [*DRAWN, "regions", ALL_VISIBLE])
def test_pictures_are_those_of_levels_that_are_not_matched(window, settle, gain_text, name):
    if name != ALL_VISIBLE:
        brought_forward(window, settle, name)

    def drawn():
        picture = window.pictures.picture_of(name)
        assert "matched" not in picture.caption
        return drawn_image(picture.draw, 700, 600)

    on = drawn()
    settle()
    # The window goes on as it was, and so does what is played.
    document = window.document
    gain = document.view.match_gain(document.design)
    assert match_text(gain) == gain_text
    expected = levels(document.design) + 20 * np.log10(gain)
    np.testing.assert_allclose(shown_levels(window), expected, rtol=0, atol=1e-9)
    window.do("match_levels")
    settle()
    assert drawn() == on


def test_curves_that_are_saved_or_copied_are_not_matched(
    window, settle, gain_text, tmp_path, monkeypatch
):
    path = tmp_path / "traces.csv"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(path), ""))
    for name in ("traces", "spectra"):
        exports = brought_forward(window, settle, name)._plot.exports

        def exported(exports=exports):
            exports.save_data()
            exports.copy_picture()
            settle()
            return path.read_text("utf-8"), QApplication.clipboard().image()

        on = exported()
        assert "matched" not in on[0]
        window.do("match_levels")
        settle()
        assert exported() == on
        window.do("match_levels")
        settle()
