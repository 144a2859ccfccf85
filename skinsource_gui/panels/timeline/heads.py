"""The heads of the tracks, one below the other, and what is done to them."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QPoint, Qt, Signal

from skinsource.design import edits
from skinsource.design.amplitudes import is_gain, peak_text
from skinsource.design.design import AMPLITUDE_GAIN, Design, amplitude_spec, audible_inputs
from skinsource.design.edits.edit import Edit, Refusal, clip_of
from skinsource.design.view import View
from skinsource_gui.fields.inputs import ENTRIES, ORDER, Entry, FieldChanges, fill_inputs_menu
from skinsource_gui.panels.timeline.content import shown_gain_curves, toggle_gain_curves
from skinsource_gui.panels.timeline.head_row import InputRow, RowState
from skinsource_gui.qt.buttons import passing_menu
from skinsource_gui.qt.keys import claims_shortcut, meaning_of
from skinsource_gui.qt.layouts import in_column

_PLACE = "inputs"
_Key, _Held = Qt.Key, Qt.KeyboardModifier
_STEPS = {_Key.Key_Up: -1, _Key.Key_Down: 1}
_EDITS: dict[str, Callable[..., Edit | Refusal]] = {
    "mute": edits.toggle_mute,
    "solo": edits.toggle_solo,
    "duplicate": edits.duplicate_inputs,
    "gain_curve": toggle_gain_curves,
    "remove": edits.remove_inputs,
}
# Height of the line that shows between which rows a drag would put the selected ones, px.
_GAP_PX = 3


@dataclass(slots=True, kw_only=True)
class _Press:
    """A press of the left button on a row; ``gap`` is where a drag would put the row."""

    id: int
    at: QPoint
    was_selected: bool
    gap: int | None = None


class InputRows(QtWidgets.QWidget):
    """The heads, which select, change, order and remove tracks.

    A press selects; with Ctrl it adds or takes out, with Shift it selects all rows on the way.
    Moving farther drags the selected rows between two others.
    """

    #: `Edit` or `Refusal`, number of the gesture or None.
    edited = Signal(object, object)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("input_rows")
        self.setAccessibleName("Inputs")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self._design, self._view = Design(limb=""), View()
        # A row stays with its track, so that an open editor survives when others come and go.
        self._rows: dict[int, InputRow] = {}
        self._layout = in_column(None, of=self, margins=0, gap_px=0)
        self._changes = FieldChanges()
        # Where a selection of all rows on the way began.
        self._anchor: int | None = None
        self._press: _Press | None = None
        self._gap = QtWidgets.QFrame(self)
        self._gap.setObjectName("input_gap")
        self._gap.setBackgroundRole(QtGui.QPalette.ColorRole.Highlight)
        self._gap.setAutoFillBackground(True)
        self._gap.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._gap.hide()

    @property
    def rows(self) -> tuple[InputRow, ...]:
        """The rows, from top to bottom."""
        return tuple(self._rows.values())

    @property
    def last_row(self) -> InputRow | None:
        """The row that was selected last."""
        last = self._view.selected_input
        return None if last is None else self._rows.get(last)

    def show_state(self, design: Design, view: View) -> None:
        """Show one row for each track."""
        self._design, self._view = design, view
        left: list[InputRow] = []
        if list(self._rows) != list(design.ids):
            self._cancel_drag()
            left = self._arrange()
        audible = {id(track) for track in audible_inputs(design.inputs)}
        amplitude = amplitude_spec(design)
        for track, row in zip(design.inputs, self.rows, strict=True):
            gain = is_gain(design, track)
            row.show_state(
                RowState(
                    track=track,
                    silent=id(track) not in audible,
                    selected=track.id in view.selected_inputs,
                    last=track.id == view.selected_input,
                    amplitude=AMPLITUDE_GAIN if gain else amplitude,
                    peak=peak_text(design, track) if gain else "",
                    clip=clip_of(track, view),
                    limb=design.limb,
                )
            )
        # The keyboard may come from a row that goes: those that stay know by now what they show.
        for row in left:
            self._remove(row)

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, partial(meaning_of, _PLACE)) or super().event(event)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() == _Key.Key_Escape and self._cancel_drag():
            return
        command, chosen = meaning_of(_PLACE, event), self._view.selected_inputs
        if not command or not self._rows:
            event.ignore()
        elif command == "go":
            self._go(_Key(event.key()), event.modifiers())
        elif command in ("shift_up", "shift_down"):
            self._edit(edits.shift_inputs, chosen, command == "shift_down")
        elif command == "select_all":
            self._edit(edits.select_all_inputs)
        elif self.last_row is None:
            event.ignore()
        elif command == "type":
            self.last_row.amplitude.setFocus(Qt.FocusReason.OtherFocusReason)
            self.last_row.amplitude.begin_editing()
        else:
            self._edit(_EDITS[command], chosen)

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        # Also reached by presses on a row, which leaves them to us.
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        row = self._row_at(event.position().y())
        if row is None or event.button() != Qt.MouseButton.LeftButton:
            return
        self._cancel_drag()
        if event.modifiers() & _Held.ControlModifier:
            self._anchor = row.id
            self._edit(edits.toggle_selected, row.id)
        elif event.modifiers() & _Held.ShiftModifier:
            self._select_through(row.id)
        else:
            at, selected = event.globalPosition().toPoint(), row.state.selected
            self._press = _Press(id=row.id, at=at, was_selected=selected)
            if not selected:
                self._select(row.id)

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        press = self._press
        if press is None or not event.buttons() & Qt.MouseButton.LeftButton:
            return
        distance_px = (event.globalPosition().toPoint() - press.at).manhattanLength()
        if press.gap is not None or distance_px >= QtWidgets.QApplication.startDragDistance():
            y = event.position().y()
            press.gap = sum(row.geometry().center().y() < y for row in self.rows)
            self._show_gap(press.gap)

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        press = self._press
        if press is None or event.button() != Qt.MouseButton.LeftButton:
            return
        if self._cancel_drag():
            self._edit(edits.put_inputs_before, self._view.selected_inputs, press.gap)
        elif press.was_selected:
            # A click on one of several selected rows selects that row alone.
            self._select(press.id)

    def contextMenuEvent(self, event: QtGui.QContextMenuEvent) -> None:
        # The menu key opens the menu of the row that was selected last, on that row.
        by_key = event.reason() == QtGui.QContextMenuEvent.Reason.Keyboard
        row = self.last_row if by_key else self._row_at(event.pos().y())
        if row is not None:
            self._enter(row)
            self._open_menu(
                self._affected(row),
                row.mapToGlobal(row.rect().center()) if by_key else event.globalPos(),
            )

    def focusInEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusInEvent(event)
        self._show_focus()

    def focusOutEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusOutEvent(event)
        self._show_focus()

    def _edit(self, edit: Callable[..., Edit | Refusal], *more: object) -> None:
        self.edited.emit(edit(self._design, self._view, *more), None)

    def _arrange(self) -> list[InputRow]:
        """Put the rows of the present tracks in order; return those that are left over."""
        old, self._rows = self._rows, {}
        before: QtWidgets.QWidget = self
        for position, track_id in enumerate(self._design.ids):
            row = old.pop(track_id, None) or self._new_row()
            self._rows[track_id] = row
            self._layout.insertWidget(position, row)
            for control in row.controls:
                QtWidgets.QWidget.setTabOrder(before, control)
                before = control
        return list(old.values())

    def _new_row(self) -> InputRow:
        row = InputRow(self)
        row.entered.connect(lambda: self._enter(row))
        row.amplitude.edited.connect(
            lambda value, gesture: self._change_amplitude(row, value, gesture)
        )
        row.mute.clicked.connect(lambda: self._edit(edits.toggle_mute, self._affected(row)))
        row.solo.clicked.connect(lambda: self._edit(edits.toggle_solo, self._affected(row)))
        # The cross removes that row alone.
        row.remove.clicked.connect(lambda: self._edit(edits.remove_inputs, (row.id,)))
        return row

    def _remove(self, row: InputRow) -> None:
        """Remove a row that is left over; its keyboard goes to the list."""
        focused = QtWidgets.QApplication.focusWidget()
        had_focus = focused is not None and row.isAncestorOf(focused)
        self._layout.removeWidget(row)
        row.amplitude.cancel()
        row.hide()
        row.deleteLater()
        if had_focus:
            self.setFocus(Qt.FocusReason.OtherFocusReason)

    def _row_at(self, y: float) -> InputRow | None:
        return next((row for row in self.rows if row.y() <= y < row.y() + row.height()), None)

    def _affected(self, row: InputRow) -> tuple[int, ...]:
        """Return the tracks that a control changes: all selected ones, if its own is among them."""
        selected = self._view.selected_inputs
        return selected if row.id in selected else (row.id,)

    def _change_amplitude(self, row: InputRow, value: float, gesture: int | None) -> None:
        ids = self._affected(row)
        changed = self._changes.change(
            self._design, self._view, ids, "amplitude", value, lead=row.id, gesture=gesture
        )
        self.edited.emit(changed, gesture)

    def _enter(self, row: InputRow) -> None:
        """Go to a row: one of several selected ones may be changed for all."""
        if row.id not in self._view.selected_inputs:
            self._select(row.id)

    def _select(self, chosen: int) -> None:
        self._anchor = chosen
        self._edit(edits.select_inputs, (chosen,))

    def _select_through(self, chosen: int) -> None:
        """Select all from where it began to this input."""
        known = self._anchor in self._view.selected_inputs
        self._anchor = self._anchor if known else self._view.selected_input
        self._edit(edits.select_through, self._anchor, chosen)

    def _go(self, key: Qt.Key, held: Qt.KeyboardModifier) -> None:
        """Select the row to which a key leads, or with Shift all on the way to it."""
        ids, last = self._design.ids, self._view.selected_input
        if last not in ids or key not in _STEPS:
            place = len(ids) - 1 if key in (_Key.Key_End, _Key.Key_Up) else 0
        else:
            place = min(max(ids.index(last) + _STEPS[key], 0), len(ids) - 1)
        # The key may have come from a control of a row that is left now.
        self.setFocus(Qt.FocusReason.OtherFocusReason)
        extending = bool(held & _Held.ShiftModifier)
        (self._select_through if extending else self._select)(ids[place])

    def _cancel_drag(self) -> bool:
        """Give up a drag; return whether there was one."""
        press, self._press = self._press, None
        self._show_gap(None)
        return press is not None and press.gap is not None

    def _show_gap(self, gap: int | None) -> None:
        self._gap.setVisible(gap is not None)
        if gap is not None:
            bottom = self.rows[gap - 1].geometry().bottom() + 1 if gap else 0
            self._gap.setGeometry(0, max(bottom - _GAP_PX // 2, 0), self.width(), _GAP_PX)
            self._gap.raise_()

    def _show_focus(self) -> None:
        if self.last_row is not None:
            self.last_row.update()

    def _open_menu(self, ids: tuple[int, ...], at: QPoint) -> None:
        menu, shown = passing_menu(self, "inputs_menu"), shown_gain_curves(self._view)
        chosen = [track for track in self._design.inputs if track.id in ids]
        gain = Entry(
            text="Gain curve",
            key="gain_curve",
            edit=toggle_gain_curves,
            on=lambda track: track.id in shown,
            separated=True,
        )
        entries = (*ENTRIES, *ORDER, gain)
        fill_inputs_menu(
            menu, chosen, lambda edit: self._edit(edit, ids), place=_PLACE, entries=entries
        )
        menu.popup(at)


class InputList(QtWidgets.QScrollArea):
    """A scroll area for `InputRows`, which keeps the row in sight that was selected last."""

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("input_list")
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.rows = InputRows()
        self.setWidget(self.rows)
        self._revealed: tuple[int, int] | None = None
        self._follows_selection = False
        bar = self.verticalScrollBar()
        # Rows that came have no place before their layout is done, and the bar no room for them.
        bar.rangeChanged.connect(self._scroll)
        bar.actionTriggered.connect(self._stop_following)

    def show_state(self, design: Design, view: View) -> None:
        """Show the tracks; scroll to the one that was selected last if it is another, or moved."""
        self.rows.show_state(design, view)
        row = self.rows.last_row
        shown = None if row is None else (row.id, self.rows.rows.index(row))
        if shown is not None and shown != self._revealed:
            self._follows_selection = True
            self._scroll()
        self._revealed = shown

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._scroll()

    def wheelEvent(self, event: QtGui.QWheelEvent) -> None:
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
