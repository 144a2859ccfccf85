"""The heads of the tracks, one below the other, and what is done to them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

from PySide6.QtCore import QEvent, QObject, QPoint, Qt, Signal
from PySide6.QtGui import (
    QContextMenuEvent,
    QFocusEvent,
    QKeyEvent,
    QMouseEvent,
    QPalette,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QApplication, QFrame, QScrollArea, QWidget

from skinsource.design import edits
from skinsource.design.amplitudes import is_gain, peak_text
from skinsource.design.design import AMPLITUDE_GAIN, Design, amplitude_spec, audible_inputs
from skinsource.design.edits.edit import clip_of
from skinsource.design.view import View
from skinsource_gui.fields.inputs import (
    ENTRIES,
    ORDER,
    Entry,
    FieldChanges,
    InputEdit,
    fill_inputs_menu,
)
from skinsource_gui.panels.timeline.content import shown_gain_curves, toggle_gain_curves
from skinsource_gui.panels.timeline.head_row import InputRow, RowSignals, RowState
from skinsource_gui.qt.buttons import passing_menu
from skinsource_gui.qt.keys import claims_shortcut, meaning_of
from skinsource_gui.qt.layouts import in_column


class CachedRows:
    """Keeps each row for its track, so that an open editor survives when other tracks come and go.

    Parameters
    ----------
    column, signals
        Parent of the rows, and the signals of their controls.
    """

    def __init__(self, column: QWidget, signals: RowSignals) -> None:
        self._column, self._signals = column, signals
        self._rows: dict[int, InputRow] = {}
        self._layout = in_column(None, of=column, margins=0, gap_px=0)

    @property
    def rows(self) -> tuple[InputRow, ...]:
        """The rows, from top to bottom."""
        return tuple(self._rows.values())

    @property
    def last(self) -> InputRow | None:
        """The row that was selected last."""
        return next((row for row in self.rows if row.state.last), None)

    def at(self, y: float) -> InputRow | None:
        """Return the row at a height of the column."""
        return next((row for row in self.rows if row.y() <= y < row.y() + row.height()), None)

    def matches(self, ids: Sequence[int]) -> bool:
        """Return whether there is a row for each of these tracks, in that order, and no other."""
        return list(ids) == list(self._rows)

    def arrange(self, ids: Sequence[int]) -> list[InputRow]:
        """Put the rows of these inputs in order; return those that are left over."""
        old, self._rows = self._rows, {}
        for position, track_id in enumerate(ids):
            row = old.pop(track_id, None) or self._new_row()
            self._rows[track_id] = row
            self._layout.insertWidget(position, row)
        before = self._column
        for row in self.rows:
            for control in row.controls:
                QWidget.setTabOrder(before, control)
                before = control
        return list(old.values())

    def remove(self, row: InputRow) -> bool:
        """Remove a row that is left over; return whether it had the keyboard."""
        focused = QApplication.focusWidget()
        had_focus = focused is not None and row.isAncestorOf(focused)
        self._layout.removeWidget(row)
        row.amplitude.cancel()
        row.hide()
        row.deleteLater()
        return had_focus

    def _new_row(self) -> InputRow:
        return InputRow(self._signals, self._column)


_PLACE = "inputs"
_Key = Qt.Key
_STEPS = {_Key.Key_Up: -1, _Key.Key_Down: 1}
_ENDS = (_Key.Key_Home, _Key.Key_End)


class ListKeys(QObject):
    """Turns key presses into signals of what they mean."""

    #: The row to go to; whether all rows on the way are selected too.
    moved = Signal(int, bool)
    #: Whether the selected inputs go down.
    shifted = Signal(bool)
    all_selected = Signal()
    removed = Signal()
    mute_toggled = Signal()
    solo_toggled = Signal()
    duplicated = Signal()
    typing_requested = Signal()
    gain_toggled = Signal()

    def claims(self, event: QKeyEvent) -> bool:
        """Return whether the list takes this key before any shortcut of the window."""
        return bool(meaning_of(_PLACE, event))

    def press(self, event: QKeyEvent, here: int | None, count: int) -> bool:
        """Tell what a key means at row ``here`` of ``count``; whether it means anything."""
        command = meaning_of(_PLACE, event)
        if not command or not count:
            return False
        if command == "go":
            extending = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
            self.moved.emit(_target(_Key(event.key()), here, count), extending)
        elif command in ("shift_up", "shift_down"):
            self.shifted.emit(command == "shift_down")
        elif command == "select_all":
            self.all_selected.emit()
        elif here is None:
            return False
        else:
            self._act(command)
        return True

    def _act(self, command: str) -> None:
        """Emit what to do with the selected tracks."""
        {
            "mute": self.mute_toggled,
            "solo": self.solo_toggled,
            "duplicate": self.duplicated,
            "type": self.typing_requested,
            "gain_curve": self.gain_toggled,
            "remove": self.removed,
        }[command].emit()


def _target(key: Qt.Key, here: int | None, count: int) -> int:
    if here is None or key in _ENDS:
        return count - 1 if key in (_Key.Key_End, _Key.Key_Up) else 0
    return min(max(here + _STEPS[key], 0), count - 1)


_Modifier = Qt.KeyboardModifier


@dataclass(slots=True, kw_only=True)
class _Press:
    """A press of the left button on a row; ``gap`` is where a drag would put the row."""

    id: int
    at: QPoint
    was_selected: bool
    gap: int | None = None


class ListMouse(QObject):
    """Turns presses, moves and releases of the mouse into signals of what they mean.

    A press selects; with Ctrl it adds or takes out, with Shift it selects all rows on the way.
    Moving farther drags the selected rows between two others.
    """

    #: Id of an input.
    selected = Signal(int)
    toggled = Signal(int)
    reached = Signal(int)
    #: The gap between rows over which the selected ones are held, or None.
    held_over = Signal(object)
    #: The gap into which the selected ones are dropped.
    dropped = Signal(int)
    #: Id of the track whose menu opens, and where on the screen.
    menu_requested = Signal(int, QPoint)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._press: _Press | None = None

    def press(self, event: QMouseEvent, id: int, was_selected: bool) -> None:
        """Begin a press on the row of a track."""
        self.cancel()
        if event.modifiers() & _Modifier.ControlModifier:
            self.toggled.emit(id)
            return
        if event.modifiers() & _Modifier.ShiftModifier:
            self.reached.emit(id)
            return
        at = event.globalPosition().toPoint()
        self._press = _Press(id=id, at=at, was_selected=was_selected)
        if not was_selected:
            self.selected.emit(id)

    def move(self, event: QMouseEvent, gap: int) -> None:
        """Follow the mouse, which is nearest to ``gap``."""
        press = self._press
        if press is None or not event.buttons() & Qt.MouseButton.LeftButton:
            return
        distance_px = (event.globalPosition().toPoint() - press.at).manhattanLength()
        if press.gap is not None or distance_px >= QApplication.startDragDistance():
            press.gap = gap
            self.held_over.emit(gap)

    def release(self) -> None:
        """End the press: drop the rows that were dragged, or select one."""
        press, self._press = self._press, None
        if press is None:
            return
        if press.gap is not None:
            self.held_over.emit(None)
            self.dropped.emit(press.gap)
        elif press.was_selected:
            # A click on one of several selected rows selects that row alone.
            self.selected.emit(press.id)

    def cancel(self) -> bool:
        """Give up a drag; return whether there was one."""
        press, self._press = self._press, None
        if press is None or press.gap is None:
            return False
        self.held_over.emit(None)
        return True


_HIGH_PX = 3


class RowGap(QFrame):
    """A line that shows between which rows a drag would put the selected ones."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._column = parent
        self.setObjectName("input_gap")
        self.setBackgroundRole(QPalette.ColorRole.Highlight)
        self.setAutoFillBackground(True)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.hide()

    def show_behind(self, above: Sequence[QWidget] | None) -> None:
        """Show it below the last of these, at the top where there is none; None: nowhere."""
        self.setVisible(above is not None)
        if above is not None:
            bottom = above[-1].geometry().bottom() + 1 if above else 0
            self.setGeometry(0, max(bottom - _HIGH_PX // 2, 0), self._column.width(), _HIGH_PX)
            self.raise_()


class InputRows(QWidget):
    """The heads, one below the other; keys and mouse go to ``keys`` and ``mouse``.

    Attributes
    ----------
    signals, keys, mouse
        Emit what controls, keys and mouse do to the rows.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("input_rows")
        self.setAccessibleName("Inputs")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.signals = RowSignals(self)
        self._cached = CachedRows(self, self.signals)
        self.keys, self.mouse = ListKeys(self), ListMouse(self)
        self.keys.typing_requested.connect(self._type_amplitude)
        self.keys.moved.connect(self._take_focus)
        self.mouse.held_over.connect(self._show_gap)
        self._gap = RowGap(self)

    @property
    def rows(self) -> tuple[InputRow, ...]:
        """The rows, from top to bottom."""
        return self._cached.rows

    @property
    def last_row(self) -> InputRow | None:
        """The row that was selected last."""
        return self._cached.last

    def show_rows(self, states: Sequence[RowState]) -> None:
        """Show one row for each state."""
        ids = [state.track.id for state in states]
        left: list[InputRow] = []
        if not self._cached.matches(ids):
            self.mouse.cancel()
            left = self._cached.arrange(ids)
        focused = self.hasFocus()
        for row, state in zip(self.rows, states, strict=True):
            row.show_state(replace(state, list_focused=True) if focused else state)
        # The keyboard may come from a row that goes: those that stay know by now what they show.
        for row in left:
            if self._cached.remove(row):
                self.setFocus(Qt.FocusReason.OtherFocusReason)

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, self._claims) or super().event(event)

    def _claims(self, event: QKeyEvent) -> bool:
        return self.keys.claims(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.mouse.cancel():
            return
        last = self.last_row
        here = None if last is None else self.rows.index(last)
        if not self.keys.press(event, here, len(self.rows)):
            event.ignore()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        # Also reached by presses on a row, which leaves them to us.
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        row = self._cached.at(event.position().y())
        if row is not None and event.button() == Qt.MouseButton.LeftButton:
            self.mouse.press(event, row.id, row.state.selected)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        y = event.position().y()
        self.mouse.move(event, sum(row.geometry().center().y() < y for row in self.rows))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self.mouse.release()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        # The menu key opens the menu of the row that was selected last, on that row.
        by_key = event.reason() == QContextMenuEvent.Reason.Keyboard
        row = self.last_row if by_key else self._cached.at(event.pos().y())
        if row is not None:
            at = row.mapToGlobal(row.rect().center()) if by_key else event.globalPos()
            self.mouse.menu_requested.emit(row.id, at)

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        self._show_focus()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self._show_focus()

    def _show_focus(self) -> None:
        for row in self.rows:
            row.show_state(replace(row.state, list_focused=self.hasFocus()))

    def _take_focus(self) -> None:
        # The key may have come from a control of a row that is left now.
        self.setFocus(Qt.FocusReason.OtherFocusReason)

    def _type_amplitude(self) -> None:
        row = self.last_row
        if row is not None:
            row.amplitude.setFocus(Qt.FocusReason.OtherFocusReason)
            row.amplitude.begin_editing()

    def _show_gap(self, gap: int | None) -> None:
        self._gap.show_behind(None if gap is None else self.rows[:gap])


class InputList(QScrollArea):
    """A scroll area for `InputRows`, which keeps the row in sight that was selected last."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("input_list")
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.rows = InputRows()
        self.setWidget(self.rows)
        self._revealed: tuple[int, int] | None = None
        self._follows_selection = False
        bar = self.verticalScrollBar()
        # Rows that came have no place before their layout is done, and the bar no room for them.
        bar.rangeChanged.connect(self._scroll)
        bar.actionTriggered.connect(self._stop_following)

    def reveal_selected(self) -> None:
        """Scroll to the row that was selected last if it is another one, or has moved."""
        row = self.rows.last_row
        shown = None if row is None else (row.id, self.rows.rows.index(row))
        if shown is not None and shown != self._revealed:
            self._follows_selection = True
            self._scroll()
        self._revealed = shown

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._scroll()

    def wheelEvent(self, event: QWheelEvent) -> None:
        self._stop_following()
        super().wheelEvent(event)

    def _stop_following(self) -> None:
        # Who scrolls wants to see something else.
        self._follows_selection = False

    def _scroll(self) -> None:
        row = self.rows.last_row
        if not self._follows_selection or row is None:
            return
        bar, top = self.verticalScrollBar(), self.rows.rows.index(row) * row.height()
        lowest = top + row.height() - self.viewport().height()
        bar.setValue(min(max(bar.value(), lowest), top))


class ListEdits(QObject):
    """Turns what controls, keys and mouse do into edits of tracks.

    ``track_id`` is that of the row whose control was used; None: a key was pressed.
    """

    #: `Edit` or `Refusal`, number of the gesture or None.
    edited = Signal(object, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._design = Design(limb="")
        self._view = View()
        self._changes = FieldChanges()

    def show_state(self, design: Design, view: View) -> None:
        """Take over the present design and view."""
        self._design, self._view = design, view

    def shift(self, down: bool) -> None:
        """Move the selected inputs past their neighbour."""
        ids = self._view.selected_inputs
        self._emit(edits.shift_inputs(self._design, self._view, ids, down))

    def put(self, gap: int) -> None:
        """Put the selected inputs into a gap between rows."""
        ids = self._view.selected_inputs
        self._emit(edits.put_inputs_before(self._design, self._view, ids, gap))

    def change_amplitude(self, track_id: int, value: float, gesture: int | None) -> None:
        """Set an amplitude that is typed or dragged."""
        ids = self.affected(track_id)
        changed = self._changes.change(
            self._design, self._view, ids, "amplitude", value, lead=track_id, gesture=gesture
        )
        self.edited.emit(changed, gesture)

    def toggle_mute(self, track_id: int | None = None) -> None:
        """Mute all, or none if all are."""
        self._emit(edits.toggle_mute(self._design, self._view, self.affected(track_id)))

    def toggle_solo(self, track_id: int | None = None) -> None:
        """Make all solo, or none if all are."""
        self._emit(edits.toggle_solo(self._design, self._view, self.affected(track_id)))

    def remove(self, track_id: int | None = None) -> None:
        """Remove the selected inputs; the cross of a row removes that row alone."""
        ids = self._view.selected_inputs if track_id is None else (track_id,)
        self._emit(edits.remove_inputs(self._design, self._view, ids))

    def edit(self, ids: tuple[int, ...], edit: InputEdit) -> None:
        """Apply an edit to these tracks."""
        self._emit(edit(self._design, self._view, ids))

    def duplicate(self) -> None:
        """Duplicate the selected inputs."""
        ids = self._view.selected_inputs
        self._emit(edits.duplicate_inputs(self._design, self._view, ids))

    def affected(self, track_id: int | None) -> tuple[int, ...]:
        """Return the tracks that a control changes: all selected ones, if its own is among them."""
        selected = self._view.selected_inputs
        return selected if track_id is None or track_id in selected else (track_id,)

    def _emit(self, outcome: edits.Edit | edits.Refusal) -> None:
        self.edited.emit(outcome, None)


class ListSelection(QObject):
    """Turns what controls, keys and mouse do into selections of tracks."""

    #: `Edit` or `Refusal`, None: no gesture.
    edited = Signal(object, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._design = Design(limb="")
        self._view = View()
        # Where a selection of all rows on the way began.
        self._anchor: int | None = None

    def show_state(self, design: Design, view: View) -> None:
        """Take over the present design and view."""
        self._design, self._view = design, view

    def enter(self, chosen: int) -> None:
        """Go to an input's number: one of several may be typed or dragged for all."""
        if chosen not in self._view.selected_inputs:
            self.select(chosen)

    def select(self, chosen: int) -> None:
        """Select this input alone."""
        self._anchor = chosen
        self._emit(edits.select_inputs(self._design, self._view, (chosen,)))

    def toggle(self, chosen: int) -> None:
        """Add this input, or take it out."""
        self._anchor = chosen
        self._emit(edits.toggle_selected(self._design, self._view, chosen))

    def select_through(self, chosen: int) -> None:
        """Select all from where it began to this input."""
        known = self._anchor in self._view.selected_inputs
        self._anchor = self._anchor if known else self._view.selected_input
        self._emit(edits.select_through(self._design, self._view, self._anchor, chosen))

    def select_all(self) -> None:
        """Select all inputs."""
        self._emit(edits.select_all_inputs(self._design, self._view))

    def go(self, place: int, extending: bool) -> None:
        """Select the input of this row, or with ``extending`` all on the way to it."""
        chosen = self._design.ids[place]
        (self.select_through if extending else self.select)(chosen)

    def _emit(self, outcome: edits.Edit | edits.Refusal) -> None:
        self.edited.emit(outcome, None)


class Heads(QObject):
    """Selects, mutes, duplicates, orders and removes tracks, and sets their amplitude.

    Attributes
    ----------
    list
        The widget.
    """

    edited = Signal(object, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.list = InputList()
        self._edits, self._selection = ListEdits(self), ListSelection(self)
        self._gain_shown: frozenset[int] = frozenset()
        self._connect()

    def show_state(self, design: Design, view: View) -> None:
        """Show the tracks of a design."""
        for part in (self._edits, self._selection):
            part.show_state(design, view)
        self._gain_shown = shown_gain_curves(view)
        audible = {id(track) for track in audible_inputs(design.inputs)}
        amplitude = amplitude_spec(design)
        peaks = {
            track.id: peak_text(design, track) for track in design.inputs if is_gain(design, track)
        }
        self.list.rows.show_rows(
            [
                RowState(
                    track=track,
                    silent=id(track) not in audible,
                    selected=track.id in view.selected_inputs,
                    last=track.id == view.selected_input,
                    list_focused=False,
                    amplitude=AMPLITUDE_GAIN if track.id in peaks else amplitude,
                    peak=peaks.get(track.id, ""),
                    clip=clip_of(track, view),
                    limb=design.limb,
                )
                for track in design.inputs
            ]
        )
        self.list.reveal_selected()

    def _connect(self) -> None:
        of_rows = self.list.rows
        rows, keys, mouse = of_rows.signals, of_rows.keys, of_rows.mouse
        selection, changes = self._selection, self._edits
        selection.edited.connect(self.edited)
        changes.edited.connect(self.edited)
        rows.entered.connect(selection.enter)
        rows.amplitude_edited.connect(changes.change_amplitude)
        rows.mute_toggled.connect(changes.toggle_mute)
        rows.solo_toggled.connect(changes.toggle_solo)
        rows.removed.connect(changes.remove)
        mouse.selected.connect(selection.select)
        mouse.toggled.connect(selection.toggle)
        mouse.reached.connect(selection.select_through)
        mouse.dropped.connect(changes.put)
        mouse.menu_requested.connect(self._open_menu)
        keys.moved.connect(selection.go)
        keys.all_selected.connect(selection.select_all)
        keys.shifted.connect(changes.shift)
        keys.mute_toggled.connect(changes.toggle_mute)
        keys.solo_toggled.connect(changes.toggle_solo)
        keys.removed.connect(changes.remove)
        keys.duplicated.connect(changes.duplicate)
        keys.gain_toggled.connect(self._toggle_gain)

    def _toggle_gain(self) -> None:
        self._edits.edit(self._edits.affected(None), toggle_gain_curves)

    def _open_menu(self, track_id: int, at: QPoint) -> None:
        self._selection.enter(track_id)
        menu = passing_menu(self.list, "inputs_menu")
        ids = self._edits.affected(track_id)
        chosen = [row.state.track for row in self.list.rows.rows if row.id in ids]
        act = partial(self._edits.edit, ids)
        gain = Entry(
            text="Gain curve",
            key="gain_curve",
            edit=toggle_gain_curves,
            on=lambda track: track.id in self._gain_shown,
            separated=True,
        )
        fill_inputs_menu(menu, chosen, act, place="inputs", entries=(*ENTRIES, *ORDER, gain))
        menu.popup(at)
