"""From the empty studio to a WAV file of four channels through an equalised voice coil."""

import json
from pathlib import Path

import compose_by_keyboard
import numpy as np
import soundfile
from composer import Composer
from PySide6.QtWidgets import QCheckBox, QFileDialog

from skinsource.actuators.actuation import Actuation, load, names
from skinsource.engine.stimulus import stimulus_of
from skinsource.signals.resampling import resample

#: The tips of four fingers.
PLACES = (7, 8, 9, 10)
#: Of the largest acceleration: between 25 and 600 Hz a boost of 20 dB leaves so much undone.
_MISSED = 0.02


def by_keyboard(you: Composer, folder: Path) -> None:
    """Four tones through an equalised voice coil to a WAV file: all typed."""
    compose_by_keyboard.reset_range(you)
    you.go_to_panel("hand")
    for place in PLACES:
        you.type(str(place))
        you.key("Enter")
        you.settle()
    you.key("F5")
    you.settle()
    you.key("Down", times=1 + names().index("example-voice-coil"))
    you.settle()
    you.tab_to("actuator_through")
    you.key("Space")
    you.settle()
    compose_by_keyboard.find(you, "export stimulus")
    page = you.page()
    you.wait(lambda: page.part.ready, "the stimulus is looked at")
    path = folder / "typed.wav"
    you.tab_to("Export…")
    you.answer(
        lambda: you.key("Space"),
        QFileDialog,
        lambda _: compose_by_keyboard.name_file(you, path),
    )
    check(you, path)


def check(you: Composer, path: Path) -> None:
    """Four channels; the voice coil that gets these volts moves as the design says."""
    beside = path.with_name(f"{path.name}.json")
    you.wait(beside.exists, f"{path.name} is written")
    you.settle()
    design = you.document.design
    you.expect(tuple(track.location for track in design.inputs) == PLACES, "four places are in use")
    you.expect(isinstance(design.actuated, Actuation), "predictions go through the actuator")
    box = you.widget("actuator_through")
    you.expect(isinstance(box, QCheckBox) and box.isChecked(), "the switch shows it")
    samples, rate_hz = soundfile.read(path, always_2d=True)
    about = json.loads(beside.read_text(encoding="utf-8"))
    you.expect(samples.shape[1] == len(PLACES), "the file has four channels")
    you.expect(about["unit"] == "V", "its samples are volts")
    you.expect(about["equaliser"]["kind"] == "RegularisedInverse", "they are equalised")
    you.expect("oltage" not in about["calibration"], "it says that it is uncalibrated")
    coil = load("example-voice-coil")
    expected = stimulus_of(design).samples
    for volts, drive in zip(samples.T * about["full_scale"], expected, strict=True):
        moved = coil.simulate(volts, rate_hz, "first").acceleration
        begin = round(-1300 * about["start_s"])
        resampled = resample(moved, rate_hz, 1300)[begin:][: drive.size]
        missed = np.abs(resampled - drive).max() / np.abs(drive).max()
        you.expect(missed < _MISSED, f"a coil misses the drive by {missed:.3f}")
