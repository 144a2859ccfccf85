"""Matched levels: a gain that is shown and played, said on every axis, and in no export."""

import csv
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import QApplication, QFileDialog

from skinsource import Design, open_design, track
from skinsource.design.comparing import match_text
from skinsource.design.design import louder
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource_gui.pages.files import exports
from skinsource_gui.panels.analysis.settings import VIEWS
from skinsource_gui.panels.compare.card import card_level_text
from skinsource_gui.panels.compare.content import of_differences, of_spread
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.plots.pictures import ALL_VISIBLE, drawn_image
from skinsource_gui.shell.status import MatchNote
from skinsource_gui.state.playing import played_of
from tests.gui.analysis.analysis_bench import analysis
from tests.gui.compare.compare_bench import choose, levels, show_matched, shown_levels
from tests.gui.exporting import export

OTHER = Design(limb="synthetic-1", inputs=(track(3),))


@pytest.fixture
def matched(window, settle):
    """Show the second of two snapshots, made softer to match the first; return its gain."""
    show_matched(window, settle)
    gain = window.document.view.match_gain(window.document.design)
    assert gain < 0.9
    return gain


def test_a_file_holds_the_amplitudes_that_were_stored(window, matched, tmp_path):
    expected = levels(window.document.design) + 20 * np.log10(matched)
    np.testing.assert_allclose(shown_levels(window), expected, rtol=0, atol=1e-9)
    assert played_of(window.document) == louder(window.document.design, matched)
    window.files._save_to(tmp_path / "a.skinsource")
    saved = open_design(tmp_path / "a.skinsource")
    assert saved.design == window.document.design == saved.view.snapshots[-1].design
    assert not window.document.modified
    # Opened again it is shown as it was left.
    assert saved.view.match_gain(saved.design) == matched


def test_it_stays_as_loud_where_levels_are_taken_otherwise(window, settle, matched):
    document, gain = window.document, matched
    document.look(replace(document.view, span="loudest"))
    settle()
    assert document.view.match_gain(document.design) == gain  # by these levels in any case
    for looked in ({"axes": "xyz", "method": "mag"}, {"axes": "z"}):
        document.look(replace(document.view, **looked))
        settle()
        before, gain = gain, document.view.match_gain(document.design)
        assert gain != before, looked
    window.do("toggle_snapshots")
    settle()
    loudest = shown_levels(window).max()
    window.do("toggle_snapshots")
    settle()
    assert document.view.match_gain(document.design) == gain
    assert shown_levels(window).max() == pytest.approx(loudest, abs=1e-6)


def test_a_pause_makes_no_snapshot_softer_and_how_long_it_makes_the_record_is_said(window, settle):
    design = window.document.design
    window.do("store_snapshot_1")
    window.document.edit("Onset", louder(design.with_clip(1, onset_s=2.0), 2.0))
    window.do("match_levels")
    panel = brought_forward(window, settle, "compare")
    earlier, later = (card.compared for card in panel.cards if card.compared)
    assert [earlier.gain, later.gain] == pytest.approx([2.0, 1.0], abs=1e-6)
    assert card_level_text(earlier) != card_level_text(later)
    assert " s long; differences" in panel.text_label.whole
    # Both play the same.
    pair = (earlier, later), (("one",), ("two",)), 0, "record"
    [difference], [_, spread] = of_differences(*pair), of_spread(*pair)
    assert difference.heading == "two equals one"
    assert spread.values_db == pytest.approx(0.0, abs=1e-6)


def test_what_is_opened_is_shown_with_the_gain_that_it_was_left_with(window, settle, matched):
    document, messages = window.document, []
    design, view = document.design, document.view
    document.start_over(OTHER, replace(view, snapshots=()), None)
    document.look(replace(document.view, outputs=(3,)))
    settle()
    document.start_over(design, view, None)
    window.comparison.done.connect(messages.append)
    document.look(replace(document.view, outputs=(20,)))
    settle()
    assert messages == []
    assert document.view.match_gain(document.design) == matched
    # It follows from what is looked at as before.
    document.look(replace(document.view, axes="z", method="mag"))
    settle()
    assert messages != []
    assert document.view.match_gain(document.design) != matched


def test_a_gain_that_is_kept_is_an_edit_that_undo_takes_back(window, settle, matched):
    before, levels_db = window.document.design, shown_levels(window)
    window.do("keep_match_gain")
    settle()
    # It is no longer shown with a gain, whatever was said when it was.
    assert window.statusBar().currentMessage().startswith("Amplitudes changed by ")
    assert window.document.design == louder(before, matched)
    np.testing.assert_allclose(shown_levels(window), levels_db, rtol=0, atol=1e-9)
    window.do("undo")
    assert window.document.design == before


def test_tables_hold_the_design_as_it_is_stored_and_say_so(
    window, settle, matched, tmp_path, monkeypatch, qtbot
):
    path = tmp_path / "levels.csv"
    monkeypatch.setattr(exports, "ask_save", lambda *_: path)
    messages = []
    window.files.done.connect(messages.append)
    export(window, "levels")
    qtbot.waitUntil(lambda: bool(messages), timeout=20_000)
    assert messages[0].endswith("levels.csv; amplitudes are as stored, levels are not matched")
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    name = "level_db_re_1_m_per_s2"
    copied_levels_db = np.array([float(row[name]) for row in rows])
    np.testing.assert_allclose(copied_levels_db, levels(window.document.design), rtol=0, atol=1e-3)


OUTPUTS = (20, 33, 29)
ANALYSIS = [spec.name for spec in VIEWS]


@pytest.fixture
def gain_text(window, settle, monkeypatch):
    """Show the second of two snapshots, made softer to match the first; by how much, in words."""
    # It takes room from the panels, whose pictures are as wide and high as they are.
    monkeypatch.setattr(MatchNote, "setVisible", lambda *_: None)
    document = window.document
    document.look(replace(document.view, outputs=OUTPUTS))
    show_matched(window, settle)
    text = match_text(document.view.match_gain(document.design))
    assert window.findChild(MatchNote).text() == text
    assert text.endswith(" dB, matched")
    return text


def brought_forward(window, settle, name):
    if name in ANALYSIS:
        analysis(window, name)
        name = "analysis"
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
    strip = brought_forward(window, settle, "windowed").view.strip
    assert strip.content.scale.text_below.endswith(gain_text)
    spectrogram = brought_forward(window, settle, "spectrogram").view.picture
    assert spectrogram.content.matched == gain_text
    wave = brought_forward(window, settle, "wave").view.picture
    wave.grab()
    assert wave.placed[1][1].y.title.endswith(f", {gain_text}")
    for name in ("statistics", "perception", "regions"):
        panel = brought_forward(window, settle, name).view
        about = panel.limits.text() if name == "perception" else panel.about.whole
        assert gain_text in about, name
    gain_db = 20 * np.log10(window.document.view.match_gain(window.document.design))
    choose(window, of="limbs")
    compare = brought_forward(window, settle, "compare").maps
    for number, cell in enumerate(compare.content.cells, 1):
        stored = levels(replace(window.document.design, limb=f"synthetic-{number}"))
        np.testing.assert_allclose(cell.values_db, stored + gain_db, atol=1e-9)
    for of in ("limbs", "axes"):
        choose(window, of=of)
        settle()
        assert compare.content.common_scale.text_below == f"dB re 1 m/s², {gain_text}"


def test_the_colour_bar_of_the_map_says_it_whatever_it_shows(window, settle, gain_text):
    document = window.document
    panel = window.panel("skin")
    for quantity in ("levels", "sensation", "z", "magnitude", "rms"):
        settings = replace(settings_of(document.view, "skin", SkinSettings), quantity=quantity)
        document.look(with_settings(document.view, "skin", settings))
        settle()
        shown = panel.map.content.quantity
        assert (shown.name, shown.matched) == (quantity, gain_text)
        assert gain_text in shown.unit
        assert gain_text in panel.measure.unit.toolTip()


@pytest.mark.parametrize("name", ["skin", "traces", "compare", "windowed", "regions", ALL_VISIBLE])
def test_pictures_are_those_of_levels_that_are_not_matched(window, settle, gain_text, name):
    panel = ALL_VISIBLE if name == ALL_VISIBLE else brought_forward(window, settle, name).name

    def drawn():
        picture = window.pictures.picture_of(panel)
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
