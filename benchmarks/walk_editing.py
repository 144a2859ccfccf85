"""Chapters of the walkthrough: placing inputs and editing them."""

from dataclasses import replace
from pathlib import Path

from driver import CONTROL, SHIFT, Driver
from PySide6.QtCore import QPoint, Qt

from skinsource_gui.state.preferences import start_design

KEY = Qt.Key


def place_inputs(you: Driver, _: Path) -> None:
    """Click, drag, keyboard, delete, undo, redo."""
    document, hand = you.window.document, you.window.panel("hand").diagram
    you.picture("start")
    you.click(hand, hand.site_centre(3))
    you.click(hand, hand.site_centre(18))
    you.picture("two more by click")
    you.expect(
        [track.location for track in document.design.inputs] == [7, 3, 18], "clicks place inputs"
    )
    you.drag(hand, hand.site_centre(18), hand.site_centre(16), "while dragging")
    you.expect(document.design.inputs[-1].location == 16, "a drag moves the input")
    you.key(KEY.Key_2)
    you.key(KEY.Key_0)
    you.key(KEY.Key_Return)
    you.picture("placed at 20 by keyboard")
    you.expect(document.design.inputs[-1].location == 20, "typing 20 and Enter places one there")
    you.key(KEY.Key_Up, SHIFT)
    you.key(KEY.Key_Delete)
    you.expect(len(document.design.inputs) == 3, "Delete removes one input, not two")
    selected = document.view.selected_input
    you.key(KEY.Key_Z, CONTROL)
    you.expect(len(document.design.inputs) == 4, "Ctrl+Z brings it back")
    you.expect(document.view.selected_input == 4, f"undo selects what came back, not {selected}")
    you.key(KEY.Key_Z, CONTROL, times=10)
    you.expect(document.design == start_design(document.design.limb), "undo leads to the start")
    you.expect(not document.modified, "at the start nothing is unsaved")
    you.key(KEY.Key_Y, CONTROL, times=20)
    you.expect(len(document.design.inputs) == 3, "redo leads to the end")
    you.key(KEY.Key_Z, CONTROL)
    you.picture("redone")


def edit_list(you: Driver, _: Path) -> None:
    """Select, mute, solo, duplicate in the list."""
    document, rows = you.window.document, you.window.panel("timeline")._list.rows
    you.click(rows.rows[0], QPoint(60, 12))
    you.expect(document.view.selected_input == 1, "a click on a row selects")
    you.key(KEY.Key_Down)
    you.key(KEY.Key_M)
    you.picture("second row muted by key")
    you.expect(document.design.inputs[1].muted, "M mutes")
    you.key(KEY.Key_M)
    you.click(rows.rows[2].solo)
    you.picture("third row solo")
    you.expect(document.design.inputs[2].solo, "the button S solos")
    you.click(rows.rows[2].solo)
    count = len(document.design.inputs)
    you.click(rows.rows[2], QPoint(60, 12))
    you.key(KEY.Key_D, CONTROL)
    you.expect(len(document.design.inputs) == count + 1, "Ctrl+D duplicates once")
    you.key(KEY.Key_Delete)
    you.expect(len(document.design.inputs) == count, "Delete in the list removes one")
    you.focus(you.window.panel("skin").map)
    you.key(KEY.Key_D, CONTROL)
    you.expect(len(document.design.inputs) == count + 1, "Ctrl+D works anywhere")
    you.key(KEY.Key_Z, CONTROL)
    you.expect(len(document.design.inputs) == count, "and is undone")


def edit_numbers(you: Driver, _: Path) -> None:
    """Kinds of waveform; numbers by typing, wheel, drag and keys; what is not allowed."""
    window, document = you.window, you.window.document
    document.look(replace(document.view, selected_inputs=(1,)))
    for kind in ("Tap", "Impulse", "Noise", "Tone"):
        field = you.widget("kind_field", window.panel("inspector"))
        you.focus(field)
        you.type(kind)
        you.picture(f"waveform {kind}")
        you.expect(document.design.clips[0].waveform.title == kind, f"typing chooses {kind}")
    field = you.widget("frequency_hz_field", window.panel("inspector"))
    you.double_click(field)
    you.picture("typing a frequency")
    you.type("0,12 kHz")
    you.key(KEY.Key_Return)
    you.expect(document.design.clips[0].waveform.frequency_hz == 120.0, "0,12 kHz is 120 Hz")
    you.type("99999")
    you.key(KEY.Key_Return)
    you.picture("a frequency out of range")
    you.expect(field.problem != "", "99999 Hz is refused with a reason")
    you.key(KEY.Key_Escape)
    you.expect(document.design.clips[0].waveform.frequency_hz == 120.0, "Esc restores")
    you.type("12x")
    you.key(KEY.Key_Return)
    you.picture("nonsense")
    before = document.undo_stack.index()
    you.key(KEY.Key_Z, CONTROL)
    you.expect(
        document.undo_stack.index() == before, "Ctrl+Z while typing does not undo the design"
    )
    you.key(KEY.Key_Escape)
    you.key(KEY.Key_Z, CONTROL)
    you.expect(document.undo_stack.index() == before - 1, "Ctrl+Z at rest undoes the design")
    you.key(KEY.Key_Z, CONTROL | SHIFT)
    you.wheel(field, 3)
    you.expect(document.design.clips[0].waveform.frequency_hz > 120.0, "the wheel turns it up")
    middle = field.rect().center()
    steps = document.undo_stack.count()
    you.drag(field, middle, middle + QPoint(80, 0))
    you.expect(document.undo_stack.count() == steps + 1, "a drag is one undo step")
    you.picture("a frequency dragged")
    onset = you.widget("onset_s_field", window.panel("inspector"))
    you.focus(onset)
    you.type("0.1 s")
    you.key(KEY.Key_Tab)
    you.expect(document.design.clips[0].onset_s == 0.1, "Tab commits 0.1 s")
    you.picture("onset of 100 ms")
