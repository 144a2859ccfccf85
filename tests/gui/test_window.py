import threading
from dataclasses import replace
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractScrollArea, QApplication, QLabel, QTextBrowser, QWidget

from benchmarks.window_figures import SCREENS, figures_of
from skinsource import Design, View, load_limb, predict, project_axes, track
from skinsource.design.waveforms.tones import Tone
from skinsource.export import packing
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.state.preferences import start_design


def test_the_first_window_plays_a_tone_on_the_pad_of_digit_ii():
    design = start_design("synthetic-3")
    (track,) = design.inputs
    assert (design.limb, design.scaling, track.location) == ("synthetic-3", "probe", 7)
    assert track.clips[0].waveform == Tone(frequency_hz=100.0)


def test_the_first_window_shows_a_prediction_of_the_start_design(window, settle):
    outcomes = []
    window.conductor.delivered.connect(outcomes.append)
    window.document.look(replace(window.document.view, axes="z"))
    settle()
    limb = load_limb("synthetic-1")
    drive = Tone(frequency_hz=100.0).samples(1300.0)
    expected = project_axes(predict(limb, [drive], [7], scaling="probe"), "z")[[28, 51]]
    np.testing.assert_allclose(
        outcomes[-1].values["selected_traces"], expected, atol=1e-12 * np.abs(expected).max()
    )
    # What was being prepared was no error.
    assert window.findChild(QLabel, "inputs_problem").property("tone") == "dim"


def test_every_control_says_what_it_is(window):
    silent = [
        child
        for child in window.findChildren(QWidget)
        if child.focusPolicy() & Qt.FocusPolicy.TabFocus
        and child.isVisibleTo(window)
        and not isinstance(child.parent(), QAbstractScrollArea)  # its viewport
        and not (child.accessibleName() or child.toolTip() or getattr(child, "text", str)())
    ]
    assert not silent, [(type(child).__name__, child.objectName()) for child in silent]


def test_closing_during_an_evaluation_ends_cleanly(open_window):
    window = open_window(
        Design(
            limb="synthetic-1",
            inputs=tuple(track(location=k, waveform=Tone(duration_s=2.0)) for k in range(1, 9)),
        ),
        View(outputs=(1, 2, 3)),
    )
    # What is quick would be done before it can be closed.
    gate = threading.Event()
    window.engine._worker.run(partial(gate.wait, 5))
    window.document.edit("a", window.document.design.with_clip(1, onset_s=0.1))
    assert window.engine.busy
    window.document.mark_saved(window.document.path)
    gate.set()
    window.close()  # the fixture sees that no thread is left


def test_about_the_data_says_the_checksum_of_the_responses(open_window, monkeypatch):
    store = SimpleNamespace(source_name="responses.mat", source_sha256="ab" * 32, note="")
    monkeypatch.setattr(packing, "describe", lambda: store)
    window = open_window(Design(limb="measured-1"))
    window.do("show_about")
    page = QApplication.activeModalWidget()
    text = page.findChild(QTextBrowser, "page_text").toPlainText()
    page.close()
    assert f"responses.mat: SHA-256 {'ab' * 32}" in text


@pytest.mark.parametrize("screen", SCREENS, ids=lambda screen: str(screen[0]))
def test_the_figures_of_the_window_hold(open_window, screen):
    figures = figures_of(open_window(), screen)
    holds = {
        "skin": figures.skin >= (0.06 if screen[0] < 1920 else 0.08),
        "arm": figures.arm >= 0.04,
        "sensors_px": figures.sensors_px >= 20.0,
        "clicked": figures.clicked,
        "traces_px": figures.traces_px >= 180,
        "spectra_px": figures.spectra_px >= 180,
        "tracks": figures.tracks >= 5,
        "hidden": not any(figures.hidden.values()),
        "controls": len(figures.controls) <= 25,
    }
    missed = {name for name, held in holds.items() if not held}
    assert not missed, f"{missed}: {figures}"


def test_a_number_that_is_being_typed_is_taken_before_whatever_is_done(window, active, answers):
    field = window.panel("inspector").findChild(NumberField, "amplitude_field")
    field.setFocus()
    QTest.keyClicks(field, "3")
    window.do("store_snapshot_1")
    assert window.document.view.snapshots[0].design.inputs[0].amplitude == 3.0
    QTest.keyClicks(field, "4")
    assert not window.close()
    assert (window.document.design.inputs[0].amplitude, len(answers["asked"])) == (4.0, 1)
