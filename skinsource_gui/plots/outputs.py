"""Selecting outputs on a map by clicks, rubber bands and keys."""

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, QPointF, QRectF, Qt, Signal

from skinsource.base.conventions import Floats
from skinsource_gui.qt.keys import meaning_of

Outputs = tuple[int, ...]

# A click selects an output from this far away.
REACH_PX = 11.0


def dorsal_outputs(points: Floats, unplaced: Outputs) -> Outputs:
    """Return the outputs on the back of hand and arm; ``points`` is (n_outputs, 2)."""
    return tuple(k for k in range(1, len(points) + 1) if k not in unplaced)


def is_placed(points: Floats, number: int) -> bool:
    """Return whether an output has a place on the map; ``points`` is (n_outputs, 2)."""
    return number <= len(points) and bool(np.isfinite(points[number - 1]).all())


def output_at(points: Floats, at: QPointF, reach_px: float = REACH_PX) -> int | None:
    """Return the output nearest to ``at`` within reach; ``points`` is (n_outputs, 2), px.

    Outputs without a place, NaN, are ignored.
    """
    distances = np.hypot(points[:, 0] - at.x(), points[:, 1] - at.y())
    distances[np.isnan(distances)] = np.inf
    nearest = int(np.argmin(distances))
    return nearest + 1 if distances[nearest] <= reach_px else None


def outputs_inside(points: Floats, area: QRectF) -> Outputs:
    """Return the outputs inside ``area``, ascending."""
    x, y = points.T
    inside = (x >= area.left()) & (x <= area.right()) & (y >= area.top()) & (y <= area.bottom())
    return tuple(int(k) + 1 for k in np.flatnonzero(inside))


def output_beyond(points: Floats, number: int, dx: int, dy: int) -> int:
    """Return the nearest output in a direction of the screen, or ``number`` if there is none."""
    steps = points - points[number - 1]
    ahead = steps @ np.array([dx, dy], float)
    sideways = np.abs(steps @ np.array([-dy, dx], float))
    # Outputs within 45 degrees first; then any that lie ahead.
    for reachable in (sideways <= ahead, sideways < np.inf):
        cost = np.where((ahead > 0.5) & reachable, ahead + 2 * sideways, np.inf)
        best = int(np.argmin(cost))
        if np.isfinite(cost[best]):
            return best + 1
    return number


def toggled(outputs: Outputs, number: int) -> Outputs:
    """Return ``outputs`` with ``number`` added at the end, or removed."""
    if number in outputs:
        return tuple(k for k in outputs if k != number)
    return (*outputs, number)


def joined(outputs: Outputs, more: Outputs) -> Outputs:
    """Return ``outputs`` with the new ones of ``more`` at the end."""
    return (*outputs, *(k for k in more if k not in outputs))


# A press that moves less than this is a click.
_CLICK_PX = 4.0
#: Keys that are held to add to the selection.
ADDS = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.ControlModifier
_ARROWS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, -1),
    Qt.Key.Key_Down: (0, 1),
}


class OutputPicker(QObject):
    """Selects the outputs of a map by clicks, rubber bands, and a cursor that keys move.

    Points are the screen places of the outputs, (n_outputs, 2), px.

    Attributes
    ----------
    selected
        The outputs that are selected at present.
    toggles
        Whether a click adds or removes an output without a key that is held.
    reach_px
        From how far away a click selects an output.
    hovered
        The output under the pointer; None while it is elsewhere.
    band
        The rubber band, while one is drawn.
    cursor_output
        The output under the cursor; None until keys are used.
    """

    #: The outputs to select, a tuple of numbers.
    chosen = Signal(object)
    #: The cursor of the keyboard is at another output.
    moved = Signal()

    def __init__(self, widget: QtWidgets.QWidget) -> None:
        super().__init__(widget)
        self.selected: Outputs = ()
        self.toggles, self.reach_px = False, REACH_PX
        self.hovered: int | None = None
        self._widget = widget
        self._on_screen: QPointF | None = None
        self.band: QRectF | None = None
        self.cursor_output: int | None = None
        self._pressed: QPointF | None = None
        # Whether keys were used later than the mouse.
        self._uses_keys = False
        # The selection when something was given up; None: something else was done since.
        self._kept: Outputs | None = None

    @property
    def pointer(self) -> QPointF | None:
        """The place of the pointer, which may rest while the widget moves; None: elsewhere."""
        return None if self._on_screen is None else self._widget.mapFromGlobal(self._on_screen)

    def pointed_at(self, *, focused: bool) -> int | None:
        """Return the output under the pointer; if ``focused``, else that under the cursor."""
        if self._on_screen is not None:
            return self.hovered
        return self.cursor_output if focused else None

    def claims(self, event: QtGui.QKeyEvent) -> bool:
        """Return whether this key is handled here, before any shortcut of the window."""
        # Until keys are used here, Space is a shortcut of the window.
        is_used = self._uses_keys or event.key() != Qt.Key.Key_Space
        return is_used and bool(meaning_of("skin", event))

    def press(self, event: QtGui.QMouseEvent) -> None:
        """Handle a button that goes down: a click or a rubber band begins."""
        self._uses_keys, self._kept = False, None
        if event.button() == Qt.MouseButton.LeftButton:
            self._pressed = event.position()

    def move(self, at: QPointF, points: Floats) -> None:
        """Follow the mouse, with or without the button."""
        self._on_screen = self._widget.mapToGlobal(at)
        self.hovered = output_at(points, at, self.reach_px)
        if self._pressed is not None:
            band = QRectF(self._pressed, at).normalized()
            if self.band is not None or max(band.width(), band.height()) >= _CLICK_PX:
                self.band = band

    def release(self, event: QtGui.QMouseEvent, points: Floats) -> None:
        """Handle the left button that goes up: select outputs, or add them to the others."""
        if self._pressed is None:
            return
        adds = bool(event.modifiers() & ADDS)
        band, self.band, self._pressed = self.band, None, None
        if band is not None:
            inside = outputs_inside(points, band)
            self._choose(joined(self.selected, inside) if adds else inside)
            return
        number = output_at(points, event.position(), self.reach_px)
        if number is not None:
            toggles = adds or self.toggles
            self._choose(toggled(self.selected, number) if toggles else (number,))

    def leave(self) -> None:
        """Forget the pointer: it is elsewhere, or the keyboard is in use."""
        self._on_screen = self.hovered = None

    def give_up(self) -> bool:
        """End a press without selecting; return whether there was one."""
        self._kept = self.selected
        pressed, self._pressed, self.band = self._pressed, None, None
        return pressed is not None

    def press_key(
        self, event: QtGui.QKeyEvent, points: Floats, unplaced: Outputs, middle: QPointF
    ) -> bool:
        """Handle a key; return whether it has a meaning for outputs.

        Parameters
        ----------
        event, points
            The key event, and the places of the outputs.
        unplaced
            Outputs beside the map.
        middle
            Middle of the map, where the cursor begins.
        """
        meaning = meaning_of("skin", event)
        kept, self._kept = self._kept, None
        if meaning == "select_none":
            # The first press only ends what is under way.
            if not self.give_up() and kept == self.selected:
                self._choose(())
            return True
        if meaning == "go":
            place = self._start(points, middle)
            if self.cursor_output is not None:
                place = output_beyond(points, place, *_ARROWS[Qt.Key(event.key())])
            self.cursor_output = place
            self.leave()
            self.moved.emit()
        elif meaning in ("select", "toggle"):
            number = self.cursor_output = self._start(points, middle)
            self._choose(toggled(self.selected, number) if meaning == "toggle" else (number,))
        elif meaning == "select_all":
            self._choose(dorsal_outputs(points, unplaced))
        else:
            return False
        self._uses_keys = True
        return True

    def _start(self, points: Floats, middle: QPointF) -> int:
        cursor = () if self.cursor_output is None else (self.cursor_output,)
        placed = [number for number in (*cursor, *self.selected) if is_placed(points, number)]
        return placed[0] if placed else output_at(points, middle, float("inf")) or 1

    def _choose(self, outputs: Outputs) -> None:
        if len(outputs) == 1:
            self.cursor_output = outputs[0]
        if outputs != self.selected:
            self.chosen.emit(outputs)
