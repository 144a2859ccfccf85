"""The panels of analysis: what they show, say, copy, and cost."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QGuiApplication, QImage, QPainter
from PySide6.QtTest import QTest

from skinsource import Design, Input, evaluate, track
from skinsource.design.edits.edit import Edit
from skinsource.design.panel_settings import SpectrogramSettings, settings_of
from skinsource.design.waveforms.pulses import Tap
from skinsource_gui.panels.analysis.settings import VIEWS, AnalysisSettings
from skinsource_gui.panels.analysis.table import OutputTableView
from skinsource_gui.plots.figure import Axis, fitted_axes
from skinsource_gui.plots.pictures import save_drawing
from skinsource_gui.qt.theme import LIGHT, scaled
from skinsource_gui.state.engine import FIRST_SLOT
from tests.gui.analysis.analysis_bench import analysis, copied

#: Panels, and the rule that each has for itself.
RULES_OF = {
    "statistics": "output_statistics",
    "spectrogram": "output_spectrogram",
    "transfer": "transfer",
    "main_axis": "output_main_axes",
    "wave": "line_wave",
    "perception": "sensation",
}


OUTPUTS = (20, 22, 24, 26)


@pytest.fixture
def show(window, settle):
    """Bring a panel forward, with outputs along digit III selected."""

    def bring(name, outputs=OUTPUTS, **changes):
        window.document.look(replace(window.document.view, outputs=outputs, **changes))
        panel = analysis(window, name)
        settle()
        return panel

    return bring


def changed(label, design, view):
    return Edit(label=label, design=design, view=view)


def test_a_hidden_panel_computes_nothing(window, show, settle):
    runs, usual = window.engine._graphs[FIRST_SLOT].runs, window.document.view
    for k, (name, rule) in enumerate(RULES_OF.items()):
        window.document.look(replace(usual, outputs=OUTPUTS))
        settle()
        assert runs[rule] == 0, name
        show(name)
        shown = runs[rule]
        assert shown == 1, name
        window.docks["analysis"].toggleViewAction().trigger()
        assert not window.panel("analysis").isVisible()
        window.document.look(replace(window.document.view, axes="z", outputs=OUTPUTS[:2]))
        design = window.document.design.with_input(0, amplitude=2.5 + k)
        window.document.apply(changed("Louder", design, window.document.view))
        settle()
        assert runs[rule] == shown, name
    # Nor while others were in sight.
    assert {runs[rule] for rule in RULES_OF.values()} == {1}


def test_without_outputs_it_says_how_to_select_some_and_then_shows_them(show, window, settle):
    for name in RULES_OF:
        panel = show(name, outputs=())
        assert "elect" in panel.message, name
        assert "on the skin map" in panel.message, name
        window.document.look(replace(window.document.view, outputs=OUTPUTS))
        settle()
        if isinstance(panel, OutputTableView):
            assert panel.table.model().rowCount() == 4
        else:
            assert panel.figure.message == "", name
            panel.grab()


def test_silence_and_many_inputs_are_shown_without_a_fault(show, window, settle):
    document = window.document
    usual = document.design
    silent = replace(usual, inputs=(replace(usual.inputs[0], muted=True),))
    many = tuple(track(1 + k % 20, Tap(), onset_s=k * 0.01) for k in range(20))
    for name in RULES_OF:
        document.apply(changed("Usual", usual, document.view))
        panel = show(name)
        document.apply(changed("Mute", silent, document.view))
        settle()
        panel.grab()
        document.apply(changed("Many", replace(silent, inputs=many), document.view))
        settle()
        panel.grab()
        assert panel.message == "" or isinstance(panel, OutputTableView), name
        document.apply(changed("None", Design(limb="synthetic-1"), document.view))
        settle()
        panel.grab()
        # What says why there is nothing has no numbers to copy.
        assert not (panel.message and window.panel("analysis").copy.isEnabled())
        window.docks["analysis"].hide()


def test_the_table_is_copied_with_numbers_that_read_back(show, window):
    panel = show("statistics")
    model = panel.table.model()
    hints = [model.data(model.index(0, k), Qt.ItemDataRole.ToolTipRole) for k in (0, 1)]
    noisy = panel.rows[0].noisy
    assert hints[0].startswith("20  III nail rad.")
    assert bool(hints[1]) is noisy
    header, *below = copied(window).splitlines()
    lines = [line for line in below if not line.startswith("# ")]
    columns = header.split("\t")
    assert [line.split("\t")[0] for line in lines] == ["20", "22", "24", "26"]
    document = window.document
    statistics = evaluate(document.design, "output_statistics", view=document.view)[
        "output_statistics"
    ]
    rms = [float(line.split("\t")[columns.index("rms_m_per_s2")]) for line in lines]
    assert rms == statistics.rms.tolist()
    delay = [float(line.split("\t")[columns.index("delay_ms")]) for line in lines]
    assert delay == pytest.approx(statistics.delay_s * 1e3)
    QGuiApplication.clipboard().clear()
    panel.table.setFocus()
    QTest.keyClick(panel.table, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    assert QGuiApplication.clipboard().text().splitlines() == [header, *below]


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("statistics", "x, z, magnitude · RMS: loudest 100 ms"),
        ("wave", "Along z: distance on the map, group delay"),
        ("perception", "people differ by 6 to 10 dB"),
        ("regions", "RMS in dB re 1 m/s², x, z, magnitude · loudest 100 ms"),
    ],
)
def test_what_numbers_are_is_copied_below_them(show, window, qtbot, name, words):
    show(name, axes="xz", method="mag", span="loudest")
    qtbot.waitUntil(window.panel("analysis").copy.isEnabled, timeout=60_000)
    below = [line for line in copied(window).splitlines() if line.startswith("# ")]
    assert sum(words in line for line in below) == 1


def test_floor_and_ceiling_zoom_without_computing(show, window, settle):
    panel = show("spectrogram")
    runs = window.engine._graphs[FIRST_SLOT].runs
    before = runs["output_spectrogram"]
    panel.floor.edited.emit(50.0, None)
    panel.ceiling.edited.emit(300.0, None)
    settle()
    panel.grab()
    assert panel.picture.content.band_hz == (50.0, 300.0)
    assert panel.picture.axes.y.shown == (50.0, 300.0)
    assert runs["output_spectrogram"] == before
    held = settings_of(window.document.view, "spectrogram", SpectrogramSettings)
    assert (held.floor_hz, held.ceiling_hz) == (50.0, 300.0)
    # One that is not above the floor counts as the top of the band.
    panel.ceiling.edited.emit(20.0, None)
    settle()
    assert panel.picture.content.band_hz == (50.0, 650.0)


def test_another_output_and_window_are_computed(show, window, settle):
    panel = show("spectrogram")
    panel.output.choose("22")
    settle()
    assert panel.note_label.whole.startswith("Output 22")
    columns = panel.picture.content.spectrogram.time_s.size
    panel.window_length.choose("200")
    settle()
    assert panel.picture.content.spectrogram.time_s.size < columns


def test_transfer_functions_are_of_the_selected_input(show, window, settle):
    panel = show("transfer")
    assert panel.place.whole.startswith("From place 7")
    document = window.document
    added = document.design.adding(track(13, Tap()))
    selected = replace(document.view, selected_inputs=(added.inputs[-1].id,))
    document.apply(changed("Add", added, selected))
    settle()
    assert panel.place.whole.startswith("From place 13")
    panel.grab()
    panel.figure.setFocus()
    QTest.keyClick(panel.figure, Qt.Key.Key_Home)
    assert panel.note_label.whole.startswith("0.0 Hz")
    QTest.keyClick(panel.figure, Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier)
    assert not panel.note_label.whole.startswith("0.0 Hz")
    assert "coherence" in panel.note_label.whole
    QTest.keyClick(panel.figure, Qt.Key.Key_Escape)
    assert panel.note_label.whole.startswith("Coherence ≥ 0.75")
    panel.coherence.click()
    settle()
    panel.grab()
    assert panel.picture.axes.y.title == "Coherence"
    rows = panel.table_text().splitlines()
    assert len(rows) == 1 + 522 // 2 + 1


def test_a_single_axis_has_no_main_axis_and_circles_say_so(show, window, settle):
    panel = show("main_axis", axes="z")
    assert panel.figure.message.startswith("A single axis has no principal axis")
    window.document.look(replace(window.document.view, axes="xyz"))
    settle()
    shown = panel.picture.content
    panel.grab()
    panel.picture.move_cursor(QPointF(30, 30))
    assert panel.note_label.whole.startswith("20 III nail rad.: x ")
    none = replace(shown.main_axes, none=np.ones(4, bool))
    panel.picture.show_axes(replace(shown, main_axes=none))
    assert panel.picture.content.text_of(0) == "20 III nail rad.: no principal axis"
    header, first, *_ = panel.table_text().splitlines()
    assert dict(zip(header.split("\t"), first.split("\t"), strict=True))["main_axis"] == "no"


def test_the_wave_says_speed_and_attenuation_along_the_selection(show, window, settle):
    panel = show("wave", outputs=(29, 31, 33, 35))
    document = window.document
    wave = evaluate(document.design, "line_wave", view=document.view)["line_wave"].wave
    assert f"attenuation {wave.attenuation_db_per_cm:.2f}" in panel.note_label.whole
    panel.grab()
    line, *dots = panel.picture.diagrams[1].curves
    slope = np.diff(line.y) / np.diff(line.x)
    assert slope == pytest.approx(-100.0 * wave.attenuation_db_per_cm)
    assert [dot.rank for dot in dots] == [0, 1, 2, 3]
    origin, axes = panel.picture.placed[1]
    places = axes.to_screen(wave.distance_m, wave.level_db) + origin.toTuple()
    panel.picture.move_cursor(QPointF(*places[2]))
    assert panel.note_label.whole.startswith("33: ")
    assert panel.table_text().splitlines()[3].startswith("33\t")
    window.document.look(replace(document.view, outputs=(20,)))
    settle()
    assert "two or more outputs" in panel.figure.message


def test_the_wave_cautions_where_inputs_at_several_places_sound(show, window, settle):
    panel = show("wave", outputs=(29, 31, 33, 35))
    design = window.document.design
    there = design.inputs[0].location
    elsewhere = there % 20 + 1
    for other, overlap in (
        (track(elsewhere, Tap()), True),
        (track(there, Tap()), False),
        (track(elsewhere, Tap(), muted=True), False),
        (track(elsewhere, Tap(), amplitude=0.0), False),
        (Input(location=elsewhere), False),
    ):
        window.document.edit("Add", replace(design, inputs=(*design.inputs, other)))
        settle()
        assert ("waves of several inputs overlap" in panel.note_label.whole) is overlap


def numbers_at(width, scale, x, height=200, *, beside=False):
    """Numbers below axes, or beside them, each with where it begins and ends along its axis."""
    written = []

    class Noting(QPainter):
        def drawText(self, room, flags, text):
            # Those beside the axis of y begin at the edge.
            if (room.left() == 0) is beside and text not in ("", x.title, LEVEL.title):
                ends = (room.top(), room.bottom()) if beside else (room.left(), room.right())
                written.append((*ends, text))

    image = QImage(width, height, QImage.Format.Format_Grayscale8)
    painter = Noting(image)
    painter.setFont(scaled(QFont("Sans", 10), scale))
    axes = fitted_axes(QRectF(0, 0, width, height), x, LEVEL, QFontMetricsF(painter.font()))
    axes.paint(painter, LIGHT)
    painter.end()
    assert axes.frame.width() > 0.3 * width
    return written


@pytest.mark.parametrize("height", [50, 56, 62, 80, 200])
def test_numbers_beside_a_low_axis_do_not_lie_on_each_other(qapp, height):
    beside = numbers_at(400, 1.0, WIDE[1], height, beside=True)
    assert beside
    # Digits are lower than a line.
    for (low, end, _), (high, _, _) in pairwise(beside):
        assert low - high > 0.75 * (end - low)


LEVEL = Axis(shown=(-60.0, 20.0), title="dB")
#: A short time late, and bands from 0 and from more than that.
WIDE = (
    Axis(shown=(1.01, 1.035), title="", factor=1e3),
    *(Axis(shown=(0.0, top), title="Hz") for top in (650.0, 2000.0, 2001.0, 24_000.0)),
    *(Axis(shown=shown, title="Hz", log=True) for shown in ((10.0, 2000.0), (1.0, 110.0))),
)


@pytest.mark.parametrize("x", WIDE)
@pytest.mark.parametrize(
    ("width", "scale"), [(200, 1.0), (200, 1.75), (240, 2.0), (303, 1.75), (600, 3.0), (900, 1.0)]
)
def test_no_number_of_an_axis_is_cut_or_lies_on_another(qapp, width, scale, x):
    numbers = numbers_at(width, scale, x)
    assert numbers
    metrics = QFontMetricsF(scaled(QFont("Sans", 10), scale))
    for (_, end, _), (begin, _, _) in pairwise(numbers):
        assert end < begin
    for begin, end, label in numbers:
        assert end - begin >= metrics.horizontalAdvance(label) - 0.01
        assert end <= width


def test_what_is_chosen_is_shown_with_what_it_answers_and_saved(window, settle):
    analysis(window, "statistics")
    panel = window.panel("analysis")
    for spec in VIEWS:
        panel.choice.choose(spec.name)
        settle()
        assert settings_of(window.document.view, "analysis", AnalysisSettings).shown == spec.name
        assert panel.view.name == spec.name
        assert panel.answer.whole == spec.answer
        assert [view.isVisible() for view in panel._views.values()].count(True) == 1
        assert panel.copy.isVisible() == panel.view.copies
        assert not panel.view.is_stale
    # What was chosen before shows the present design when it is chosen again.
    panel.choice.choose("statistics")
    settle()
    before = panel.view.rows
    panel.choice.choose("regions")
    window.document.edit("Louder", window.document.design.with_input(0, amplitude=5.0))
    settle()
    panel.choice.choose("statistics")
    settle()
    assert panel.view.rows[0].values[0] == pytest.approx(5.0 * before[0].values[0])
    assert panel.copy.isEnabled()
    # What an audience is to guess is covered in each view that is chosen.
    panel.show_covered(True)
    panel.choice.choose("windowed")
    assert panel.view._covers
    panel.show_covered(False)
    assert not panel.view._covers


def test_a_second_one_beside_the_first_shows_another_view_or_the_same(window, settle):
    window.do("arrange_analysis")
    first = analysis(window, "statistics")
    second = analysis(window, "main_axis", "analysis_2")
    settle()
    assert first.isVisible()
    assert second.isVisible()
    assert first.rows
    assert second.message == ""
    panel = window.panel("analysis_2")
    panel.choice.choose("statistics")
    settle()
    assert window.panel("analysis").view is first
    assert [row.values for row in panel.view.rows] == [row.values for row in first.rows]
    assert not panel.view.is_stale


@pytest.mark.parametrize("visible", [True, False])
def test_a_picture_of_another_view_leaves_the_chosen_one(window, settle, tmp_path, visible):
    panel, shown = window.panel("analysis"), analysis(window, "statistics")
    window.docks["analysis"].setVisible(visible)
    settle()
    picture = window.pictures.picture_of("analysis/windowed")
    save_drawing(tmp_path / "a.svg", picture.draw, 900, 700)
    text = (tmp_path / "a.svg").read_text("utf-8")
    assert " in windows" in text
    assert (panel.view, panel.choice.value) == (shown, "statistics")
    window.docks["analysis"].bring_forward()
    settle()
    assert shown.rows
    assert not shown.is_stale


LINE = (29, 31, 33, 35)


@pytest.mark.parametrize("removed", [False, True])
def test_the_spectrogram_reads_its_times_with_the_delay_and_without_it(show, removed):
    picture = show("spectrogram", LINE, delay_removed=removed).picture
    spectrogram = picture.content.spectrogram
    assert picture.content.first_s == pytest.approx(-0.052 if removed else 0.0)
    assert picture.axes.x.shown[0] == pytest.approx(-0.005 if removed else 0.0)
    row, column = np.unravel_index(np.argmax(spectrogram.amplitude), spectrogram.amplitude.shape)
    time_s = spectrogram.time_s[column] + picture.content.first_s
    place = picture.axes.to_screen(np.array([time_s]), spectrogram.frequency_hz[[row]])[0]
    text = picture.read(QPointF(*place))
    assert text.startswith(f"{time_s * 1e3:.1f} ms · {spectrogram.frequency_hz[row]:.1f} Hz")
    level_db = 20.0 * np.log10(spectrogram.amplitude.max())
    assert text.endswith(f"{level_db:.1f} dB re 1 m/s²".replace("-", "\N{MINUS SIGN}"))
    assert (picture.axes.x.title, picture.axes.x.factor) == ("Time (ms)", 1e3)


def test_the_wave_is_copied_in_millimetres_and_milliseconds(show, window):
    panel = show("wave", LINE)
    header, *below = copied(window).splitlines()
    lines = [line for line in below if not line.startswith("# ")]
    columns = np.array([line.split("\t") for line in lines]).T
    numbers = dict(zip(header.split("\t"), columns, strict=True))
    document = window.document
    wave = evaluate(document.design, "line_wave", view=document.view)["line_wave"].wave
    assert numbers["way_mm"].astype(float) == pytest.approx(1e3 * wave.distance_m)
    assert numbers["delay_ms"].astype(float) == pytest.approx(1e3 * wave.delay_s)
    assert numbers["level_z_db_re_1_m_per_s2"].astype(float) == pytest.approx(wave.level_db)
    # About 95 mm along the finger and the hand.
    assert 50.0 < numbers["way_mm"].astype(float)[-1] < 200.0
    for diagram, title in ((0, "Delay (ms)"), (1, "Level z (dB)")):
        axes = panel.picture.placed[diagram][1]
        assert (axes.x.factor, axes.y.title) == (1e3, title)


def test_a_spectrogram_is_in_seconds_from_where_traces_are(show):
    picture = show("spectrogram", LINE).picture
    spectrogram = picture.content.spectrogram
    for last_s, title in ((0.9, "Time (ms)"), (1.1, "Time (s)")):
        time_s = np.linspace(0.0, last_s, spectrogram.time_s.size)
        picture.show_spectrogram(
            replace(picture.content, spectrogram=replace(spectrogram, time_s=time_s))
        )
        picture.grab()
        assert picture.axes.x.title == title
        text = picture.read(picture.axes.frame.center())
        assert title.endswith(f"({text.split()[1]})")
