"""The page of stimuli remembers how the last one was exported."""

import pytest
from PySide6.QtWidgets import QFileDialog

import skinsource as ss
from skinsource.design.view import View
from skinsource_gui.pages.stimulus.form import StimulusForm, recall, remembered

WAIT = {"timeout": 30_000}
DESIGN = ss.Design(
    limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Gabor(200.0), amplitude=0.5),)
)
COIL = ss.ActuatorAt(actuator="coil", model=ss.actuators.load("example-voice-coil"))


@pytest.fixture
def form(qtbot):
    form = StimulusForm(DESIGN, View())
    qtbot.addWidget(form)
    return form


@pytest.fixture
def other(qtbot):
    form = StimulusForm(DESIGN, View())
    qtbot.addWidget(form)
    return form


def orders(form):
    changes = []
    form.changed.connect(changes.append)
    form.emit_order()
    return changes[-1]


def test_the_next_page_exports_as_the_last_one_did(form, other):
    form.field("format").choose("flac")
    form.field("rate").choose("96000")
    form.field("lead_in").set_value(0.25)
    form.field("lead_in").edited.emit(0.25, None)
    form.field("sync").setChecked(True)
    recall(other, remembered(form))
    assert orders(other) == orders(form)
    assert orders(other).options.lead_in_s == 0.25


def test_choices_of_a_format_are_kept_with_it(form, other):
    form.field("format").choose("wav")
    name = next(iter(form.chosen))
    last = form.field(name).itemData(form.field(name).count() - 1)
    form.field(name).choose(last)
    recall(other, remembered(form))
    assert other.chosen == form.chosen
    assert other.chosen[name] == last


def test_a_name_without_an_ending_gets_all_of_it_and_the_format_is_remembered(
    make_desk, qtbot, monkeypatch, tmp_path
):
    desk, name = make_desk(DESIGN), str(tmp_path / "x.tsv")
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (name, ""))
    desk.exports.show("stimulus")
    page = desk.exports.page.part
    page.form.field("format").choose("bids")
    qtbot.waitUntil(lambda: page.ready and not page.busy, **WAIT)
    page.window().chosen.emit()
    qtbot.waitUntil(lambda: (tmp_path / "x_stim.tsv.gz").exists(), **WAIT)
    desk.exports.show("stimulus")
    assert desk.exports.page.part.form.field("format").value == "bids"
    desk.exports.end()
