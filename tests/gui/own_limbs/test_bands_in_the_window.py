"""What the window says of frequencies: in the band that the lab says, or nothing."""

import pytest
from PySide6.QtWidgets import QLabel

from skinsource.design import edits
from skinsource.design.design import Design, track
from skinsource.design.presets.presets import read_preset_folder, shipped_folder
from skinsource.design.view import View
from skinsource.design.waveforms.tones import Tone
from tests.core.own_limbs.lab_bench import installed
from tests.gui.analysis.analysis_bench import analysis

WIDE_BAND = Design(limb="synthetic-1", inputs=(track(5, Tone(frequency_hz=900.0, duration_s=0.1)),))


@pytest.fixture
def open_window(make_window):
    """Each test has a window of its own."""
    return make_window


@pytest.mark.parametrize("band", [None, (40.0, 1500.0), (40.0, 800.0)])
def test_the_advice_beside_fields_asks_the_limb(user_data, open_window, qtbot, band):
    installed(band_hz=band)
    edit = edits.change_limb(WIDE_BAND, View(selected_inputs=(1,), outputs=(3,)), "lab-1")
    window = open_window(edit.design, edit.view)
    for name in ("inspector", "clip_editor", "spectra"):
        window.docks[name].bring_forward()
    analysis(window, "spectrogram")
    qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)
    window.catch_up()
    note = window.findChild(QLabel, "frequency_hz_note")
    warned = band is not None and band[1] < 900.0
    assert ("outside the measured band (40 to 800 Hz)" in note.text()) is warned
    axis = window.panel("spectra")._axis
    assert axis.band == band
    assert ("measured band 40 to" in axis.titles[0]) is (band is not None)
    spectrogram = window.panel("analysis").view
    assert spectrogram.picture.content.band_hz == (0.0, 2000.0)
    assert spectrogram.ceiling.value_si == 2000.0
    library = window.panel("library")
    library.preview.show_limb("lab-1")
    library.preview.show_preset(read_preset_folder(shipped_folder()).entries[0].preset)
    assert library.preview.spectrum._band_hz == band
    library.preview.grab()
