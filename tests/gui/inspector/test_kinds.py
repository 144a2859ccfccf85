"""Kinds of waveforms: in a menu, each with its picture, and in the inspector; parts of layers."""

import os
import sys
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QIcon, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QLineEdit, QMenu, QToolButton, QWidget

from skinsource import Clip, Design, Input, waveforms
from skinsource.base.allocation import give_freed_memory_back
from skinsource.base.run_limited import resident_bytes
from skinsource.design.describing import figure_text, full_label, stimulus_text
from skinsource.design.display_units import value_text
from skinsource.design.edits.edit import as_kind, kind_spec
from skinsource.design.effects import Fade, Stretch, Trim
from skinsource.design.waveforms import (
    COMMON,
    KINDS,
    MORE,
    Chirp,
    Formula,
    Layers,
    Noise,
    Tone,
    WaveletTrain,
)
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import NumberSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.grid import FieldGrid
from skinsource_gui.fields.inputs import clip_text
from skinsource_gui.fields.kinds import PICTURE_PX, KindField, fill_kind_menu, waveform_icon
from skinsource_gui.fields.parts import PartsEditor
from skinsource_gui.fields.text_field import LiveText
from skinsource_gui.qt.buttons import FirstLetters, LetterButton
from skinsource_gui.qt.theme import LIGHT
from tests.gui.inspector.bench import Bench, design_of
from tests.gui.wheel import NOTCH, turn_wheel


@pytest.fixture
def menu(qtbot):
    owner = QWidget()
    qtbot.addWidget(owner)
    # Kept until the test is over: the menu goes with it.
    yield QMenu(owner)
    owner.close()


@pytest.fixture
def field(qtbot):
    field = KindField(kind_spec())
    qtbot.addWidget(field)
    field.show()
    qtbot.waitExposed(field)
    return field


def titles(menu: QMenu) -> list[str]:
    return [action.text() for action in menu.actions()]


def more_of(menu: QMenu) -> QMenu:
    return menu.findChild(QMenu, "more_kinds")


def ink(icon: QIcon, mode: QIcon.Mode = QIcon.Mode.Normal) -> np.ndarray:
    """How much of each pixel is drawn on."""
    image = icon.pixmap(PICTURE_PX, 1.0, mode).toImage()
    alpha = image.convertToFormat(QImage.Format.Format_Alpha8)
    return np.array(alpha.constBits(), np.uint8).reshape(alpha.height(), -1)[:, : alpha.width()]


def test_with_its_picture_the_field_needs_no_more_room_than_other_choices(field, qtbot):
    other = ChoiceField(kind_spec())
    qtbot.addWidget(other)
    assert field.minimumSizeHint().width() <= other.minimumSizeHint().width()


def test_every_kind_has_a_picture_of_its_own(qapp):
    pictures = {kind: ink(waveform_icon(kind, LIGHT)) for kind in KINDS}
    for picture in pictures.values():
        assert picture.shape == (PICTURE_PX.height(), PICTURE_PX.width())
        # From left to right, and not at the edges, where it would be cut.
        assert (picture.max(axis=0) > 0).sum() >= PICTURE_PX.width() - 8
        assert picture[0].max() < 128 > picture[-1].max()
    assert len({picture.tobytes() for picture in pictures.values()}) == len(KINDS)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only glibc can free all at once")
def test_pictures_keep_their_pixels_and_nothing_that_qt_painted_them_with(qapp):
    def held() -> int:
        give_freed_memory_back()
        return resident_bytes(os.getpid())

    draw = waveform_icon.__wrapped__  # without its cache
    draw(KINDS[0], LIGHT)
    before = held()
    pictures = [draw(kind, LIGHT) for kind in KINDS]
    assert held() < before + 20e6
    assert not any(picture.isNull() for picture in pictures)


def test_eight_kinds_are_seen_at_once_and_the_rest_under_more(menu):
    fill_kind_menu(menu, str)
    assert titles(menu) == [*(kind.title for kind in COMMON), "More"]
    assert titles(more_of(menu)) == [kind.title for kind in MORE]
    assert len(COMMON) == 8
    assert all(not action.icon().isNull() for action in menu.actions()[:8])
    assert all(not action.icon().isNull() for action in more_of(menu).actions())


@pytest.mark.parametrize("kind", [COMMON[2], MORE[1]])
def test_the_present_kind_and_the_way_to_it_are_bold(menu, kind):
    fill_kind_menu(menu, str, current=kind.__name__)
    actions = *menu.actions(), *more_of(menu).actions()
    bold = [action.text() for action in actions if action.font().bold()]
    assert bold == ([kind.title] if kind in COMMON else ["More", kind.title])


def test_the_field_opens_the_menu_and_takes_what_is_chosen_there(qtbot, field):
    chosen = []
    field.edited.connect(lambda kind, gesture: chosen.append(kind))
    field.set_value("Tone")
    QTest.mouseClick(field, Qt.MouseButton.LeftButton)
    menu = field.findChild(QMenu, "kind_menu")
    qtbot.waitUntil(menu.isVisible)
    more_of(menu).actions()[0].trigger()
    menu.close()
    assert chosen == [MORE[0].__name__]
    assert field.value == MORE[0].__name__
    assert field.currentText() == MORE[0].title
    qtbot.waitUntil(lambda: field.findChild(QMenu, "kind_menu") is None)
    field.showPopup()
    assert field.findChild(QMenu, "kind_menu").isVisible()
    field.hidePopup()


def test_letters_that_are_typed_find_the_waveform_in_the_open_list(qtbot, field):
    field.showPopup()
    menu = field.findChild(QMenu, "kind_menu")
    qtbot.waitUntil(menu.isVisible)

    def found(letters):
        # A word of its own, as after a pause.
        menu.findChild(FirstLetters)._pause.stop()
        for letter in letters:
            QTest.keyClick(QApplication.activePopupWidget(), letter)
        return QApplication.activePopupWidget().activeAction().text()

    assert found("no") == "Noise"
    assert found("damped s") == "Damped sine"
    assert found("t") != found("t")
    for kind in KINDS:
        assert found(kind.title[:-1]) == kind.title
    QTest.keyClick(QApplication.activePopupWidget(), Qt.Key.Key_Return)
    assert field.value == KINDS[-1].__name__


@pytest.mark.parametrize("key", [Qt.Key.Key_Escape, Qt.Key.Key_Return])
def test_a_list_that_was_opened_by_the_mouse_leaves_the_keyboard_where_it_was(qtbot, key):
    bench = Bench(qtbot, design_of(Tone()))
    field, before = bench.panel.findChild(KindField), QLineEdit(bench.panel)
    before.show()
    bench.panel.activateWindow()
    before.setFocus()
    qtbot.waitUntil(before.hasFocus)
    QTest.mouseClick(field, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: QApplication.activePopupWidget() is not None)
    QTest.keyClick(QApplication.activePopupWidget(), key)
    qtbot.waitUntil(lambda: QApplication.activePopupWidget() is None)
    assert before.hasFocus()


def test_every_kind_can_become_every_other():
    for kind, other in product(waveforms.KINDS, repeat=2):
        assert type(as_kind(kind(), other, 1300.0)) is other


@pytest.mark.parametrize("kind", [waveforms.WaveletTrain, waveforms.Glide, waveforms.Formula])
def test_fields_that_hold_much_fit_the_panel_whatever_was_shown_before(qtbot, kind):
    bench = Bench(qtbot, design_of(kind()))
    grid = bench.panel.findChildren(FieldGrid)[1]
    bench.panel.resize(1000, 460)
    qtbot.waitUntil(lambda: grid.width() > 900)
    bench.panel.resize(300, 460)
    qtbot.waitUntil(lambda: grid.width() <= 300)


def test_a_length_that_follows_from_other_fields_is_said_anew(qtbot):
    bench = Bench(qtbot, design_of(waveforms.Gabor()))
    assert bench.label("fixed_length").text() == "50.9 ms (66 samples)"
    bench.type("cycles", "8")
    assert bench.label("fixed_length").text() == "102 ms (132 samples)"


@pytest.mark.parametrize(
    ("waveform", "figure", "whole"),
    [
        (waveforms.Tone(), "Tone 100 Hz", ""),
        (waveforms.Impulse(), "Impulse", ""),
        (waveforms.WaveletTrain((84.1,)), "Wavelet train 84.1 Hz", None),
        (waveforms.Glide(), "Glide 60–240 Hz", None),
        (waveforms.Chirp(start_hz=600.0, end_hz=25.0), "Chirp 600–25 Hz", ""),
        (waveforms.Noise(), "Noise 25–600 Hz", " (seed 0)"),
        (waveforms.Square(), "Square 100 Hz", " (duty cycle 0.5)"),
        (waveforms.Layers(), "Layers", " (Tone 100 Hz)"),
    ],
)
def test_a_waveform_is_named_with_its_frequencies_and_in_full_with_more(waveform, figure, whole):
    assert figure_text(waveform) == figure
    assert whole is None or full_label(waveform) == f"{figure}{whole}"


@pytest.mark.parametrize("kind", waveforms.KINDS, ids=lambda kind: kind.__name__)
def test_no_kind_is_told_without_a_number_that_it_has(kind):
    waveform = kind()
    for name, spec in specs_of(waveform).items():
        if isinstance(spec, NumberSpec) and spec.unit != "rad" and name != "duration_s":
            number = value_text(getattr(waveform, name), spec.unit, digits=4).split()[0]
            assert number in full_label(waveform), name


@pytest.mark.parametrize(
    ("effect", "text", "through"),
    [
        (Fade(), "Tone 100 Hz", "200 ms through fade"),
        (Stretch(to_s=0.1), "Tone 100 Hz, stretched ×0.5", "100 ms through stretch ×0.5"),
        (
            Stretch(factor=2.0, pitch="stays"),
            "Tone 100 Hz",
            "400 ms through stretch ×2 that keeps frequencies",
        ),
        (Stretch(factor=2.0, on=False), "Tone 100 Hz", "200 ms"),
        (
            Trim(start_s=0.05, duration_s=0.1),
            "Tone 100 Hz, trimmed",
            "100 ms through trim to 50–150 ms of 200 ms",
        ),
    ],
)
def test_words_on_a_clip_say_by_what_it_is_stretched_and_which_part_plays(effect, text, through):
    clip = Clip(waveform=Tone(frequency_hz=100.0, duration_s=0.2), effects=(effect,))
    assert clip_text(clip) == text
    design = Design(limb="synthetic-1", inputs=(Input(location=7, clips=(clip,)),))
    assert stimulus_text(design).endswith(f": Tone 100 Hz, {through}")


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
        self.rows[index].title.set_open(True)
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
    assert [row.title.open for row in bench.rows] == [False] * 3 + [True] * 2
    assert bench.labels == ["Add to parts of input at 7 (II pad)"] * 2
    # Layers in layers have a list of their own.
    inner = bench.opened(4)["parts"].field
    bench.add("Noise", inner)
    assert [type(part.waveform) for part in bench.parts[4].waveform.parts] == [Tone, Noise]


def test_keys_move_and_a_button_removes_parts_each_as_one_step(bench):
    bench.rows[0].title.set_open(True)
    bench.rows[0].title.setFocus()
    QTest.keyClick(bench.rows[0].title, _Key.Key_Down, _ALT)
    assert bench.parts == (B, A, C)
    assert bench.rows[1].title.hasFocus()
    QTest.keyClick(bench.rows[2].title, _Key.Key_Up, _ALT)
    assert bench.parts == (B, C, A)
    assert [row.title.open for row in bench.rows] == [False, False, True]
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


BALANCED = WaveletTrain(gains_db=(-6.56, -2.81, 0.0, -1.25, -3.75))


@pytest.mark.parametrize("waveform", [BALANCED, Layers((Clip(waveform=BALANCED),))])
def test_frequencies_typed_anew_keep_their_gains_which_the_wheel_leaves_in_sight(qtbot, waveform):
    bench = PartsBench(qtbot, design_of(waveform))
    if waveform is not BALANCED:
        bench.opened(0)
    lines = {line.accessibleName(): line for line in bench.panel.findChildren(LiveText)}
    labels = {label.text() for label in bench.panel.findChildren(QLabel)}
    assert {"Frequencies (Hz)", "Gains (dB)"} <= labels
    lines["Frequencies"].selectAll()
    QTest.keyClicks(lines["Frequencies"], "400, 237.8, 141.4, 84.1, 50")
    gains, one_line = lines["Gains"], lines["Gains"].fontMetrics().height()
    assert f"gains_db={BALANCED.gains_db[::-1]}" in repr(bench.track.clips[0].waveform)
    gains.setFixedWidth(150)
    assert gains.height() > 2 * one_line
    assert not turn_wheel(gains.viewport(), QPoint(9, 9), (0, -NOTCH))
    assert gains.verticalScrollBar().maximum() == 0


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
