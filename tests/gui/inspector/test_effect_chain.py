"""The chain of effects of the selected clip, in the inspector."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QCheckBox, QScrollArea, QToolButton

from skinsource import Clip, Design, Input, edits
from skinsource.design.effects import EFFECTS, BandLimit, Envelope, Fade, Repeat, Reverse, Stretch
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.fields.curve_field import CurveField
from skinsource_gui.panels.inspector.effects import EffectChain
from tests.gui.inspector.bench import Bench
from tests.gui.menus import lines_at

CHAIN = (Reverse(), Fade(), Repeat())


class ChainBench(Bench):
    """The panel, and the chain in it."""

    @property
    def chain(self):
        return self.panel.findChild(EffectChain)

    @property
    def effects(self):
        return self.track.clips[0].effects

    @property
    def titles(self):
        return [row.title.text() for row in self.chain.rows]

    def add(self, title):
        menu = self.panel.findChild(QToolButton, "add_effect").menu()
        menu.aboutToShow.emit()
        next(action for action in menu.actions() if action.text() == title).trigger()


@pytest.fixture
def bench(qtbot):
    clips = (Clip(id=1, waveform=Tone(), effects=CHAIN), Clip(id=2, onset_s=0.5))
    inputs = (Input(location=7, clips=clips), Input(location=3, clips=()))
    bench = ChainBench(qtbot, Design(limb="synthetic-1", inputs=inputs))
    bench.open("effects_fold")
    return bench


def test_every_effect_can_be_added_and_stands_open(bench):
    for kind in EFFECTS:
        bench.add(kind.title)
        assert type(bench.effects[-1]) is kind
        assert bench.titles[-1] == kind.title
        assert bench.chain.rows[-1].title.open
    assert len(bench.effects) == len(CHAIN) + len(EFFECTS)


def test_what_was_added_is_in_sight_and_has_the_keyboard(bench, qtbot):
    area = bench.panel.findChild(QScrollArea, "inspector_fields")
    bench.panel.resize(320, 420)
    for title in ("Repeat", "Fade"):
        bench.add(title)
        row = bench.chain.rows[-1]
        assert row.title.text() == title
        qtbot.waitUntil(row.title.hasFocus)
        sight = area.viewport().rect()

        def whole(row=row, sight=sight):
            top = row.mapTo(area.viewport(), QPoint(0, 0)).y()
            return top >= 0 and top + row.height() <= sight.height()

        qtbot.waitUntil(whole)
    # One that comes back by undo leaves the keyboard where it is.
    before = bench.design
    bench.chain.rows[0].removed.emit()
    field = bench.panel.findChild(QToolButton, "add_effect")
    field.setFocus()
    bench.show(before)
    assert field.hasFocus()


def test_a_field_is_typed_and_steps_of_a_burst_share_a_gesture(bench):
    row = bench.chain.rows[1]
    QTest.mouseClick(row.title, Qt.MouseButton.LeftButton)
    assert row.title.open
    field = bench.number("effect_in_s")
    assert field.isVisible()
    bench.type("effect_in_s", "30")
    assert bench.effects[1] == replace(CHAIN[1], in_s=0.03)
    for _ in range(3):
        QTest.keyClick(field, Qt.Key.Key_Up)
    gestures = bench.gestures[1:]
    assert len(gestures) == 3
    assert len({None, *gestures}) == 2
    assert field.hasFocus()


def test_what_does_not_go_together_is_refused_beside_the_field(bench):
    bench.add("Band limit")
    row = bench.chain.rows[-1]
    bench.type("effect_low_hz", "700")
    assert bench.effects[-1] == BandLimit()
    assert "expected less than high_hz" in row.cell("low_hz").note
    assert bench.number("effect_low_hz").value_si == 25.0


def test_keys_walk_open_switch_and_remove(bench):
    bench.chain.rows[0].title.setFocus()
    QTest.keyClick(bench.chain.rows[0].title, Qt.Key.Key_End)
    last = bench.chain.rows[2]
    assert last.title.hasFocus()
    QTest.keyClick(last.title, Qt.Key.Key_Return)
    assert last.title.open
    QTest.keyClick(last.title, Qt.Key.Key_Up, Qt.KeyboardModifier.AltModifier)
    assert bench.effects == (CHAIN[0], CHAIN[2], CHAIN[1])
    QTest.keyClick(last.title, Qt.Key.Key_Down, Qt.KeyboardModifier.AltModifier)
    assert last.title.hasFocus()
    QTest.keyClick(last.title, Qt.Key.Key_M)
    assert not bench.effects[2].on
    QTest.keyClick(last.title, Qt.Key.Key_Up)
    assert bench.chain.rows[1].title.hasFocus()
    QTest.keyClick(bench.chain.rows[1].title, Qt.Key.Key_Delete)
    assert [type(effect) for effect in bench.effects] == [Reverse, Repeat]
    assert bench.chain.rows[1].title.hasFocus()


def drag(bench, index, to_row, *, below, drop=True):
    """Drag the title of a row onto the upper or lower part of another one."""
    title, target = bench.chain.rows[index].title, bench.chain.rows[to_row].title
    start = title.rect().center()
    on_target = QPoint(start.x(), target.height() - 2 if below else 2)
    end = title.mapFromGlobal(target.mapToGlobal(on_target))
    QTest.mousePress(title, Qt.MouseButton.LeftButton, pos=start)
    QTest.mouseMove(title, end)
    QApplication.processEvents()
    if drop:
        QTest.mouseRelease(title, Qt.MouseButton.LeftButton, pos=end)
    return title


@pytest.mark.parametrize(
    ("index", "to_row", "below", "order"),
    [(0, 2, True, (1, 2, 0)), (0, 1, True, (1, 0, 2)), (2, 0, False, (2, 0, 1))],
)
def test_a_dragged_effect_goes_where_it_is_dropped(bench, index, to_row, below, order):
    row = bench.chain.rows[index]
    drag(bench, index, to_row, below=below)
    assert bench.effects == tuple(CHAIN[k] for k in order)
    assert bench.labels == ["Reorder effects of clip at 7 (II pad)"]
    assert bench.chain.rows[bench.effects.index(CHAIN[index])] is row


def test_a_drag_that_is_given_up_changes_nothing(bench):
    title = drag(bench, 0, 2, below=True, drop=False)
    QTest.keyClick(title, Qt.Key.Key_Escape)
    QTest.mouseRelease(title, Qt.MouseButton.LeftButton)
    assert bench.effects == CHAIN
    assert bench.edits == []
    drag(bench, 1, 1, below=False)
    assert bench.edits == []


def test_the_chain_is_that_of_the_selected_clip(bench):
    bench.show(selected_clips=(2,))
    assert bench.titles == []
    bench.add("Fade")
    assert bench.track.clips[0].effects == CHAIN
    assert bench.track.clips[1].effects == (Fade(0.02, 0.02),)
    # One that is added goes to all selected clips.
    bench.show(selected_clips=(1, 2))
    bench.add("Reverse")
    assert [clip.effects[-1] for clip in bench.track.clips] == [Reverse(), Reverse()]
    assert bench.labels[-1] == "Add reverse to 2 clips"
    bench.show(selected_inputs=(2,), selected_clips=())
    assert not bench.chain.isVisible()


def two_clips(qtbot, first, second):
    clips = (Clip(id=1, effects=first), Clip(id=2, onset_s=0.5, effects=second))
    inputs = (Input(location=7, clips=clips),)
    bench = ChainBench(qtbot, Design(limb="synthetic-1", inputs=inputs))
    bench.open("effects_fold")
    bench.show(selected_clips=(1, 2))
    return bench


def test_fields_of_effects_that_all_selected_clips_have_say_mixed_and_set_all(qtbot):
    bench = two_clips(
        qtbot, (Stretch(factor=2.0), Fade(0.01, 0.02)), (Stretch(factor=2.0), Fade(0.01, 0.05))
    )
    bench.chain.rows[1].title.set_open(True)
    field = bench.number("effect_out_s")
    assert bench.number("effect_in_s").text() == "10"
    assert (field.text(), field.placeholderText()) == ("", "mixed")
    assert bench.panel.findChild(QToolButton, "effects_fold").text() == "Effects · 2"
    bench.type("effect_out_s", "30")
    assert [clip.effects[1].out_s for clip in bench.track.clips] == [0.03, 0.03]
    assert bench.labels == ["Change fade out of 2 clips"]
    assert field.placeholderText() == ""
    bench.chain.rows[1].removed.emit()
    assert [clip.effects for clip in bench.track.clips] == [(Stretch(factor=2.0),)] * 2
    assert bench.label("played_length").text() == "400 ms"
    bench.show(bench.design.with_clip(1, effects=(Stretch(factor=3.0),)))
    assert bench.label("played_length").text() == "mixed"


def test_a_switch_that_is_mixed_is_half_on_and_a_click_switches_all_on(qtbot):
    bench = two_clips(qtbot, (Fade(),), (Fade(on=False),))
    switch = bench.panel.findChild(QCheckBox, "effect_switch")
    assert switch.checkState() == Qt.CheckState.PartiallyChecked
    switch.click()
    assert [clip.effects[0].on for clip in bench.track.clips] == [True, True]
    switch.click()
    assert [clip.effects[0].on for clip in bench.track.clips] == [False, False]
    assert switch.checkState() == Qt.CheckState.Unchecked


def test_where_kinds_of_effects_differ_it_says_so_and_that_the_last_clip_is_changed(qtbot):
    bench = two_clips(qtbot, (Reverse(), Fade(0.01, 0.01)), (Fade(0.02, 0.02),))
    assert bench.panel.findChild(QToolButton, "effects_fold").text() == "Effects · mixed"
    note = bench.label("effects_note")
    assert note.isVisible()
    bench.chain.rows[0].title.set_open(True)
    field = bench.chain.rows[0].cell("in_s").field
    assert field.text() == "20"
    field.setFocus()
    QTest.keyClicks(field, "30")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert [clip.effects[-1] for clip in bench.track.clips] == [Fade(0.01, 0.01), Fade(0.03, 0.02)]
    bench.show(selected_clips=(2,))
    assert not note.isVisible()


def test_the_menu_of_an_effect_copies_and_removes(bench):
    asked, row = [], bench.chain.rows[1]
    bench.panel.action_requested.connect(asked.append)
    for name in ("Copy effects", "Replace effects", "Remove fade"):
        lines_at(bench.panel, "effect_menu", row.title, QPoint(5, 5))[name].trigger()
    # The clip that is shown is what they act on.
    assert (asked, bench.view.selected_clips) == (["copy_effects", "paste_effects"], (1,))
    assert bench.titles == ["Reverse", "Repeat"]


def test_an_envelope_is_drawn_in_its_row(bench):
    bench.add("Envelope")
    field = bench.panel.findChild(CurveField, "effect_points_field")
    field.setFocus()
    QTest.keyClick(field, Qt.Key.Key_Down)
    assert bench.effects[-1] == Envelope(((0.0, 0.95, "straight"), (0.4, 1.0, "straight")))
    assert bench.labels[-1] == "Change points of clip at 7 (II pad)"
    # What a key adds ends with the clip, as in its editor.
    assert field.end_x == bench.track.clips[0].duration_s


def test_what_was_typed_for_an_effect_that_is_removed_goes_to_no_other(qtbot):
    bench = two_clips(qtbot, (Fade(0.01, 0.01), Fade(0.02, 0.02)), ())
    bench.show(selected_clips=(1,))
    bench.chain.rows[0].title.set_open(True)
    field = bench.chain.rows[0].cell("in_s").field
    field.setFocus()
    QTest.keyClicks(field, "77")
    bench.show(edits.remove_effect(bench.design, bench.view, 1, 0).design)
    QApplication.processEvents()
    assert bench.effects == (Fade(0.02, 0.02),)
    assert bench.edits == []
