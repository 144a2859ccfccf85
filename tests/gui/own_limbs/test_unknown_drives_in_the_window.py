"""What the window says of amplitudes and frequencies: where the limb answers the probe, or not."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QEvent
from PySide6.QtWidgets import QApplication, QLabel, QToolButton

from skinsource import Actuation, ActuatorAt, Design, View, edits, track
from skinsource.actuators.actuation import load
from skinsource.actuators.equalising import RegularisedInverse
from skinsource.design.design import Snapshot
from skinsource.design.presets.presets import read_preset_folder, shipped_folder
from skinsource.design.waveforms.tones import Tone
from skinsource.limbs.own_limbs import remove_limb
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.plots.pictures import caption_of
from tests.core.own_limbs.lab_bench import installed
from tests.core.playing.synthetic_sound import SyntheticSoundLibrary, use
from tests.gui.analysis.analysis_bench import analysis
from tests.gui.shared_window import rest

UNDRIVEN = Design(
    limb="synthetic-1", inputs=(track(3, Tone(frequency_hz=100.0, duration_s=0.1), amplitude=0.5),)
)
LOOKED = View(selected_inputs=(1,), outputs=(3, 9))
DRIVE, PROBE, COMPUTED = "lab-1", "lab-2", "synthetic-1"
WAIT = {"timeout": 30_000}


@pytest.fixture
def limbs(user_data):
    installed()
    installed(name=PROBE, per_unit_drive=False)


def on(limb, **changes):
    edit = edits.change_limb(replace(UNDRIVEN, **changes), LOOKED, limb)
    return edit.design, edit.view


def symbol_of(field):
    return field.spec.unit


def shown_unit(window):
    """The unit of amplitudes as panels and captions say it."""
    caption = caption_of(window.document.design)
    played = window.panel("output").findChild(QLabel, "output_words").text()
    assert window.docks["inspector"].in_sight
    return {
        "clip": checked_unit(window.panel("inspector")._fields._amplitude.field),
        "caption": caption.partition("Place 3, 0.5 ")[2].partition(":")[0],
        "played": played.partition("an amplitude of 1 ")[2].partition(" is full scale")[0],
    }


def checked_unit(field):
    """Unit of a field whose tooltip says the same."""
    assert ("unit of the drive" in field.toolTip()) is (symbol_of(field) == "a.u.")
    assert "of the probe" not in field.toolTip() or symbol_of(field) == "m/s²"
    return symbol_of(field)


def shows(window, qtbot, unit):
    rest(window)
    assert set(shown_unit(window).values()) == {unit}, shown_unit(window)
    meaning = window.panel("inspector").findChild(QToolButton, "scaling")
    hint = next(action.toolTip() for action in meaning.menu().actions() if action.isChecked())
    assert ("unit of the drive" in hint) is (unit == "a.u.")
    assert ("of the probe" in hint) is (unit == "m/s²")


@pytest.fixture
def opened(limbs, open_window, qtbot, monkeypatch):
    use(monkeypatch, SyntheticSoundLibrary(Two=2))
    window = open_window(*on(DRIVE))
    window.docks["output"].bring_forward()
    rest(window)
    return window


def test_another_limb_changes_the_unit_everywhere_at_once(opened, qtbot):
    shows(opened, qtbot, "a.u.")
    limb = opened.findChild(ChoiceField, "limb")
    for name, unit in ((PROBE, "m/s²"), (DRIVE, "a.u."), (COMPUTED, "m/s²"), (DRIVE, "a.u.")):
        limb.choose(name)
        shows(opened, qtbot, unit)


def test_a_transfer_function_is_per_what_is_driven(opened):
    analysis(opened, "transfer")
    rest(opened)
    picture, limb = opened.panel("analysis").view.picture, opened.findChild(ChoiceField, "limb")
    assert picture.content.unit == "1 m/s² per sample of 1"
    limb.choose(PROBE)
    rest(opened)
    assert picture.content.unit == "1 (m/s²)/(m/s²)"
    coil = ActuatorAt(model=load("example-voice-coil"))
    for equaliser, unit in ((None, "V"), (RegularisedInverse(), "(m/s²)")):
        through = Actuation(actuators=(coil,), equaliser=equaliser)
        opened.document.edit("Drive", replace(opened.document.design, actuation=through))
        rest(opened)
        assert picture.content.unit == f"1 (m/s²)/{unit}"


def test_of_a_limb_that_goes_the_unit_is_not_known_until_it_is_back(opened, qtbot):
    opened.findChild(ChoiceField, "limb").choose(PROBE)
    shows(opened, qtbot, "m/s²")
    remove_limb(PROBE)
    QApplication.sendEvent(opened, QEvent(QEvent.Type.WindowActivate))
    rest(opened)
    assert set(shown_unit(opened).values()) == {"a.u."}
    installed(name=PROBE, per_unit_drive=False)
    QApplication.sendEvent(opened, QEvent(QEvent.Type.WindowActivate))
    shows(opened, qtbot, "m/s²")


def test_strengths_of_snapshots_are_told_in_it(limbs, open_window, qtbot):
    design, view = on(DRIVE)
    designs = [design.with_input(0, amplitude=k) for k in (1.0, 2.0, 4.0)]
    snapshots = tuple(Snapshot(number=k, design=design) for k, design in enumerate(designs, 1))
    window = open_window(design, replace(view, snapshots=snapshots, levels_matched=False))
    panel = analysis(window, "linearity")
    qtbot.waitUntil(lambda: panel.result is not None and not window.engine.busy, **WAIT)
    over, growth, _ = panel.picture.diagrams
    assert growth.x.title == "Strength (a.u.)"
    assert over.y.title == "Normalised (m/s² per a.u.)"
    assert panel.velocity.isHidden()


@pytest.mark.parametrize(("limb", "unit"), [(DRIVE, "a.u."), (PROBE, "m/s²")])
def test_pages_ask_for_drives_in_it(limbs, make_desk, qtbot, monkeypatch, limb, unit):
    use(monkeypatch, SyntheticSoundLibrary(Two=2))
    desk = make_desk(*on(limb))
    motion = desk.show_motion()
    cells = {cell.name: cell for cell in motion.fields.cells}
    assert symbol_of(cells["amplitude"].field) == unit
    motion.reject()
    desk.exports.show("stimulus")
    page = desk.exports.page.part
    qtbot.waitUntil(lambda: not page.busy, **WAIT)
    assert symbol_of(page.form._numbers["full_scale"]) == unit
    summary = page.findChild(QLabel, "stimulus_summary").text()
    assert f"full scale = 0.5 {unit}, not equalised (raw " in summary
    desk.exports.end()
    desk.playback.matching.show()
    drive = desk.playback.matching.page.form.field("amplitude")
    assert symbol_of(drive) == unit
    desk.playback.matching.end()


WIDE_BAND = Design(limb="synthetic-1", inputs=(track(5, Tone(frequency_hz=900.0, duration_s=0.1)),))


@pytest.mark.parametrize("band", [None, (40.0, 1500.0), (40.0, 800.0)])
def test_the_advice_beside_fields_asks_the_limb(user_data, make_window, band):
    installed(band_hz=band)
    edit = edits.change_limb(WIDE_BAND, View(selected_inputs=(1,), outputs=(3,)), "lab-1")
    window = make_window(edit.design, edit.view)
    for name in ("inspector", "clip_editor", "spectra"):
        window.docks[name].bring_forward()
    analysis(window, "spectrogram")
    rest(window)
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
