"""From the window to the written file: what is seen, said, exported and in the sidecar agrees.

The command writes the same bytes as the window.
"""

import json
from dataclasses import replace

import numpy as np
import pytest
import soundfile
from PySide6.QtWidgets import QFileDialog, QLabel

import skinsource as ss
from skinsource.__main__ import main
from skinsource.actuators.rigs import Rig, RigChannel
from skinsource.design import edits
from skinsource.design.amplitudes import amplitude_text
from tests.gui.compare.compare_bench import show_matched
from tests.gui.output.bench import brought_forward, choose
from tests.gui.shared_window import rest
from tests.gui.stimulus.conftest import opened
from tests.gui.stimulus.stimulus_bench import export, label

WAIT = {"timeout": 30_000}
RATE_HZ = 48_000
# What an equaliser needs before and after the stimulus.
SILENCE = round(0.1 * RATE_HZ)
BURST = ss.waveforms.Gabor(frequency_hz=200.0, cycles=8.0)
DESIGN = ss.Design(
    limb="synthetic-1",
    inputs=(ss.track(7, BURST, onset_s=0.1, amplitude=2.0), ss.track(12, BURST, onset_s=0.2)),
)
COIL, TITLE = "kastor-2023-air", "Fingertip voice coil, in air"
RIG = Rig(
    title="Bench 3",
    channels=tuple(
        RigChannel(place=place, output=output, actuator=COIL, full_scale_v=20.0, polarity=polarity)
        for output, (place, polarity) in enumerate(((7, "normal"), (12, "inverted")), 1)
    ),
)


@pytest.fixture
def window(open_window, qtbot):
    window = open_window(DESIGN)
    rest(window)
    return window


@pytest.fixture
def page(window, qtbot):
    """Open the page of exports."""

    def show():
        return opened(window, qtbot)

    yield show
    window.exports.end()


@pytest.fixture
def written(window, qtbot, monkeypatch, tmp_path, capsys):
    """Export by the page and by the command; return samples, sidecar, and what the page said."""

    def both(page, *options):
        said = label(page, "summary")
        by_hand, typed = tmp_path / "hand" / "a.wav", tmp_path / "typed" / "a.wav"
        by_hand.parent.mkdir()
        monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(by_hand), ""))
        export(window, page, qtbot)
        ss.save_design(tmp_path / "d.skinsource", window.document.design)
        command = ["export", str(tmp_path / "d.skinsource"), "--out", str(typed)]
        assert main([*command, *options]) == 0
        capsys.readouterr()
        assert typed.read_bytes() == by_hand.read_bytes()
        about, typed_about = (
            json.loads(path.with_name("a.wav.json").read_text(encoding="utf-8"))
            for path in (by_hand, typed)
        )
        assert about == typed_about
        samples, _ = soundfile.read(by_hand, always_2d=True)
        return samples.T * about["full_scale"], about, said

    return both


def seen_peak(window, place):
    """The largest acceleration of the drive at a place that the design shows."""
    samples = window.panel("timeline").lanes.content.drawn
    (track,) = (track for track in window.document.design.inputs if track.location == place)
    return abs(track.amplitude) * max(
        float(np.abs(samples[c.id].samples).max()) for c in track.clips
    )


@pytest.mark.parametrize("rig", [None, RIG])
def test_an_actuator_that_is_chosen_and_not_predicted_through(window, page, written, qtbot, rig):
    before = window.panel("skin").map.content.values.copy()
    panel = brought_forward(window, qtbot)
    choose(panel, "actuator", COIL)
    if rig is not None:
        document = window.document
        document.apply(edits.choose_rig(document.design, document.view, rig))
    rest(window)
    # Seen and said: what the skin feels of the accelerations, and what they are exported for.
    np.testing.assert_array_equal(window.panel("skin").map.content.values, before)
    assert not panel.through.isChecked()
    title = TITLE if rig is None else "Bench 3"
    assert title in window.playback.button.text()
    volts, about, said = written(page())
    assert f"equalised for {title} (regularised inverse), lead-in 0.1 s" in said
    assert about["equalised"] == f"Equalised for {title} (regularised inverse)"
    assert about["equaliser"]["kind"] == "RegularisedInverse"
    named = {place: each["name"] for each in about["actuator"] for place in each["places"]}
    assert named == dict.fromkeys((7, 12), TITLE if rig is None else COIL)
    assert about["rig"] == (None if rig is None else "Bench 3")
    assert about["predicted_through"] is None
    # Exported: the voltages under which the coil makes these accelerations.
    drives = np.pad(ss.stimulus_of(DESIGN, RATE_HZ).samples, ((0, 0), (SILENCE, SILENCE)))
    full_v = (1.0, 1.0) if rig is None else (20.0, -20.0)
    coil = ss.actuators.load(COIL)
    for row, drive, scale in zip(volts, drives, full_v, strict=True):
        made = ss.equalising.equalised(drive, RATE_HZ, coil, ss.equalising.RegularisedInverse())
        np.testing.assert_allclose(row * scale, made, atol=2e-4 * np.abs(made).max())


def test_an_option_of_the_command_goes_before_the_design(tmp_path, capsys):
    actuator = ss.ActuatorAt(actuator=COIL, model=ss.actuators.load(COIL))
    equaliser = ss.equalising.RegularisedInverse(boost_db=12.0)
    actuation = ss.Actuation(actuators=(actuator,), equaliser=equaliser, on=False)
    design = replace(DESIGN, actuation=actuation, rig=RIG)
    ss.save_design(tmp_path / "d.skinsource", design)

    def about(*options):
        out = tmp_path / "a.wav"
        assert main(["export", str(tmp_path / "d.skinsource"), "--out", str(out), *options]) == 0
        capsys.readouterr()
        found = json.loads((tmp_path / "a.wav.json").read_text(encoding="utf-8"))
        return found["rig"], found["equaliser"] and found["equaliser"]["boost_db"]

    assert about() == ("Bench 3", 12.0)
    assert about("--rig", "none") == (None, 12.0)
    assert about("--equalise", "none") == ("Bench 3", None)
    assert about("--equalise", "linear", "--boost", "3") == ("Bench 3", 3.0)


def test_a_recording_in_g(window, page, written, qtbot, tmp_path):
    time_s = np.arange(1300) / 1300.0
    g = 0.5 * np.sin(2.0 * np.pi * 100.0 * time_s) * np.hanning(1300)
    table = np.stack((time_s, g), axis=1)
    path = tmp_path / "shaker.csv"
    np.savetxt(path, table, delimiter=",", header="time (s),acceleration (g)", comments="")
    window.document.edit("Clear", replace(DESIGN, inputs=()))
    window.imports.open_page(path)
    importing = window.imports.pages[-1]
    qtbot.waitUntil(lambda: not importing.busy, **WAIT)
    texts = " ".join(each.text() for each in importing.findChildren(QLabel))
    peak = 9.80665 * np.abs(g).max()
    assert f"{peak:.3g}" in texts
    importing.accept()
    rest(window)
    design = window.document.design
    (track,) = design.inputs
    # Between the samples too.
    assert amplitude_text(design, track) == f"gain 1, peak {9.80665 * 0.5:.3g} m/s²"
    assert seen_peak(window, track.location) == pytest.approx(peak, rel=1e-6)
    drives, about, said = written(page())
    # The file has the peaks between the samples too.
    exact = np.abs(ss.stimulus_of(design, RATE_HZ).samples).max()
    assert np.abs(drives).max() == pytest.approx(exact, rel=1e-6)
    assert exact == pytest.approx(peak, rel=0.01)
    assert (about["unit"], about["inputs"][0]["amplitude"]) == ("m/s²", 1.0)
    assert f"full scale = {exact:.3g} m/s²" in said


def test_a_snapshot_that_is_shown_matched(window, page, written, qtbot):
    show_matched(window, lambda: rest(window))
    design = window.document.design
    gain = window.document.view.match_gain(design)
    assert gain < 0.9
    # Seen: other levels, which the frame round the window and the note say.
    frame = window.findChild(type(window._match_note._frame), "match_frame")
    assert frame.geometry() == window.rect()
    assert not frame.mask().contains(window.rect().center())
    assert "matched" in window._match_note.text()
    # Exported: what was stored.
    drives, about, _ = written(page())
    np.testing.assert_allclose(drives, ss.stimulus_of(design, RATE_HZ).samples, atol=1e-5)
    amplitudes = [track["amplitude"] for track in about["inputs"]]
    assert amplitudes == [track.amplitude for track in design.inputs]
    window.do("match_levels")
    rest(window)
    assert window._match_note._frame is None
