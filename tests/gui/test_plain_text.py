"""Texts of designs, files and limbs are shown letter by letter: none is read as HTML."""

import os

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication, QDialog, QLabel, QMessageBox, QTextEdit, QToolTip

from skinsource import Actuation, ActuatorAt, Design, Input, View, actuators
from skinsource.design.clips import Clip, Fragment, Lane, Marker
from skinsource.design.design import Snapshot
from skinsource.design.presets.presets import Preset, save_preset, users_folder
from skinsource.design.waveforms.samples import Recording
from tests.core.own_limbs.lab_bench import N_INPUTS, N_OUTPUTS, installed
from tests.gui.shared_window import rest

HOSTILE = '<img src="x.png">'
CLIP = Clip(label=HOSTILE, waveform=Recording(name=HOSTILE))
PAGES = (
    "show_scenes",
    "own_limbs",
    "check_recording",
    "export_stimulus",
    "make_motion",
    "save_to_library",
    "match_strength",
    "edit_rig",
    "show_notes",
    "show_accuracy",
    "show_dataset",
    "show_about",
)


def design_on(limb):
    return Design(
        limb=limb,
        inputs=(Input(location=1, clips=(CLIP,)), Input(location=2, clips=(CLIP,), muted=True)),
        actuation=Actuation(
            actuators=(ActuatorAt(actuator=HOSTILE, model=actuators.load("kastor-2023-air")),),
            rig=HOSTILE,
            on=False,
        ),
        markers=(Marker(time_s=0.1, name=HOSTILE),),
        title=HOSTILE,
        author=HOSTILE,
        notes=HOSTILE,
        licence=HOSTILE,
    )


@pytest.fixture
def unread(tmp_path, monkeypatch):
    """The picture that these texts name, which nobody may open."""
    monkeypatch.chdir(tmp_path)
    picture = tmp_path / "x.png"
    picture.write_bytes(b"not read")
    os.utime(picture, (1, 1))
    yield
    assert picture.stat().st_atime == 1
    picture.read_bytes()
    if picture.stat().st_atime == 1:
        pytest.skip("this file system does not say when a file was read")


@pytest.fixture(params=["own limb", "missing limb"])
def window(request, unread, user_data, open_window):
    """The studio, in which every text that is not its own is HTML."""
    lane = Lane(location=1, clips=(CLIP,))
    save_preset(
        users_folder(),
        Preset(name=HOSTILE, source=HOSTILE, description=HOSTILE, fragment=Fragment(lanes=(lane,))),
    )
    limb = installed(
        title=HOSTILE,
        input_names=(HOSTILE,) * N_INPUTS,
        output_names=(HOSTILE,) * N_OUTPUTS,
        note=HOSTILE,
    )
    design = design_on(limb.name if request.param == "own limb" else HOSTILE)
    other = Snapshot(number=1, design=design.with_input(0, amplitude=0.5))
    return open_window(design, View(selected_inputs=(1,), snapshots=(other,)))


def shown_letter_by_letter():
    """How many labels and pages show the text, after none is found that reads it as HTML."""
    count = 0
    for widget in QApplication.allWidgets():
        if isinstance(widget, QLabel) and widget.isVisible():
            plain = widget.textFormat() is Qt.TextFormat.PlainText
            # What the studio itself formats is not shown as its letters.
            assert ("</" if plain else "<img") not in widget.text(), widget.objectName()
            count += "<img" in widget.text()
        elif isinstance(widget, QTextEdit) and widget.isVisible():
            assert "<img" not in widget.toHtml(), widget.objectName()
            count += "<img" in widget.toPlainText()
    return count


def test_in_every_panel_and_on_every_page(window, qtbot):
    count = 0
    for name, dock in window.docks.items():
        dock.bring_forward()
        qtbot.waitUntil(lambda name=name: window.panel(name).isVisible())
        rest(window)
        count += shown_letter_by_letter()
    assert count > 0
    for action in PAGES:
        window.do(action)
        QApplication.processEvents()
        shown_letter_by_letter()
        for page in [dialog for dialog in window.findChildren(QDialog) if dialog.isVisible()]:
            page.close()


def test_in_every_tooltip_notice_and_question(window, qtbot):
    window.reports.complain(HOSTILE)
    question = QMessageBox(QMessageBox.Icon.Question, HOSTILE, HOSTILE, parent=window)
    qtbot.addWidget(question)
    question.setInformativeText(HOSTILE)
    question.show()
    QToolTip.showText(QPoint(5, 5), HOSTILE, window)
    QApplication.processEvents()
    assert shown_letter_by_letter() >= 3
    QToolTip.hideText()
