"""The parts of layers, in the inspector."""

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit, QMenu, QToolButton

from skinsource.design.clips import Clip
from skinsource.design.waveforms import Chirp, Formula, Layers, Noise, Tone
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.parts import PartsEditor
from skinsource_gui.qt.buttons import LetterButton
from tests.gui.inspector.bench import Bench, design_of

A = Clip(waveform=Tone(50.0))
B = Clip(waveform=Noise(seed=3), gain=0.5)
C = Clip(waveform=Chirp(), onset_s=0.25)
_Key, _ALT = Qt.Key, Qt.KeyboardModifier.AltModifier


class PartsBench(Bench):
    """The panel, and the list of parts in it."""

    @property
    def cell(self):
        return next(c for c in self.panel.findChildren(FieldCell) if c.name == "parts")

    @property
    def editor(self) -> PartsEditor:
        return self.cell.field

    @property
    def rows(self):
        return self.editor.rows

    @property
    def titles(self):
        return [row.title.accessibleName() for row in self.rows]

    @property
    def parts(self):
        return self.track.clips[0].waveform.parts

    def add(self, title, editor=None):
        add = (editor or self.editor).findChild(QToolButton, "add_part")
        menu = add.menu()
        menu.aboutToShow.emit()
        menus = [menu, *menu.findChildren(QMenu)]
        actions = [action for menu in menus for action in menu.actions()]
        next(action for action in actions if action.text() == title).trigger()

    def opened(self, index):
        self.rows[index].set_open(True)
        return {cell.name: cell for cell in self.rows[index].fields.cells}


@pytest.fixture
def bench(qtbot):
    return PartsBench(qtbot, design_of(Layers((A, B, C)), Tone()))


def press(bench, index, name):
    bench.rows[index].findChild(LetterButton, name).click()


def test_a_part_of_any_waveform_is_added_and_stands_open(bench):
    bench.add("Formula")
    bench.add("Layers")
    assert bench.parts[:3] == (A, B, C)
    assert [type(part.waveform) for part in bench.parts[3:]] == [Formula, Layers]
    assert [row.open for row in bench.rows] == [False] * 3 + [True] * 2
    assert bench.labels == ["Add to parts of input at 7 (II pad)"] * 2
    # Layers in layers have a list of their own.
    inner = bench.opened(4)["parts"].field
    bench.add("Noise", inner)
    assert [type(part.waveform) for part in bench.parts[4].waveform.parts] == [Tone, Noise]


def test_keys_move_and_a_button_removes_parts_each_as_one_step(bench):
    bench.rows[0].set_open(True)
    bench.rows[0].title.setFocus()
    QTest.keyClick(bench.rows[0].title, _Key.Key_Down, _ALT)
    assert bench.parts == (B, A, C)
    assert bench.rows[1].title.hasFocus()
    QTest.keyClick(bench.rows[2].title, _Key.Key_Up, _ALT)
    assert bench.parts == (B, C, A)
    assert [row.open for row in bench.rows] == [False, False, True]
    press(bench, 1, "remove_button")
    assert bench.parts == (B, A)
    assert bench.titles == ["1 · Noise", "2 · Tone"]
    verbs = ["Reorder", "Reorder", "Remove from"]
    assert bench.labels == [f"{name} parts of input at 7 (II pad)" for name in verbs]
    assert [gesture for _, _, gesture in bench.edits] == [None] * 3


def test_the_fields_of_a_part_are_edited(bench):
    cells = bench.opened(0)
    assert list(cells) == [
        *("kind", "frequency_hz", "phase_rad", "duration_s", "window"),
        *("onset_s", "gain", "muted", "label", "effects"),
    ]
    QTest.keyClicks(cells["frequency_hz"].field, "75")
    QTest.keyClick(cells["frequency_hz"].field, _Key.Key_Return)
    assert bench.parts == (replace(A, waveform=Tone(75.0)), B, C)
    QTest.keyClick(cells["onset_s"].field, _Key.Key_Up)
    QTest.keyClick(cells["onset_s"].field, _Key.Key_Up)
    assert bench.parts[0].onset_s == 0.01
    # Steps of one burst share a gesture.
    assert bench.edits[-1][2] == bench.edits[-2][2] is not None
    cells["muted"].field.click()
    assert bench.parts[0].muted
    assert bench.titles[0] == "1 · Tone (off)"
    label = cells["label"].field
    assert isinstance(label, QLineEdit)
    QTest.keyClicks(label, "low")
    QTest.keyClick(label, _Key.Key_Return)
    assert bench.titles[0] == "1 · low (off)"


def test_another_kind_of_waveform_brings_its_own_fields(bench):
    cells = bench.opened(0)
    cells["kind"].field.setFocus()
    cells["kind"].field.choose("Noise")
    assert type(bench.parts[0].waveform) is Noise
    after = {cell.name: cell for cell in bench.rows[0].fields.cells}
    assert {"seed", "low_hz", "high_hz"} <= set(after)
    assert after["kind"] is cells["kind"]
    assert after["kind"].field.hasFocus()
    assert after["seed"].isVisible()
    # Back, from elsewhere: what was focused and goes hands the keyboard on.
    after["seed"].field.setFocus()
    bench.show(bench.design.with_input(0, clips=(Clip(id=1, waveform=Layers((A, B, C))),)))
    assert bench.parts == (A, B, C)
    assert cells["kind"].field.hasFocus()


def test_the_last_part_stays_and_that_is_said(bench):
    for _ in range(2):
        press(bench, 0, "remove_button")
    assert bench.parts == (C,)
    remove = bench.rows[0].findChild(LetterButton, "remove_button")
    assert not remove.isEnabled()
    assert remove.toolTip() == "At least 1 has to stay"
    bench.rows[0].title.setFocus()
    QTest.keyClick(bench.rows[0].title, _Key.Key_Delete)
    assert bench.parts == (C,)
    assert bench.cell.note == "Parts: at least 1 has to stay."
    bench.add("Tone")
    assert bench.cell.note == ""


def test_a_refused_value_is_shown_again_with_the_reason_at_its_field(bench):
    cells = bench.opened(2)
    low, high = (cells[name] for name in ("start_hz", "end_hz"))
    bench.opened(1)
    noise = {cell.name: cell for cell in bench.rows[1].fields.cells}
    QTest.keyClicks(noise["low_hz"].field, "640")
    QTest.keyClick(noise["low_hz"].field, _Key.Key_Return)
    assert bench.parts == (A, B, C)
    assert noise["low_hz"].field.value_si == B.waveform.low_hz
    assert "low_hz" in noise["low_hz"].note
    assert (low.note, high.note) == ("", "")
