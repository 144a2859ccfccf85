"""Which output is meant by a click, a rubber band or an arrow key."""

import numpy as np
from PySide6.QtCore import QObject, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent

from skinsource.base.arrays import Floats
from skinsource_gui.qt.keys import meaning_of

Outputs = tuple[int, ...]

# How far from an output it is still meant.
_REACH_PX = 11.0


def dorsal_outputs(points: Floats, unplaced: Outputs) -> Outputs:
    """Numbers of the outputs on the back of hand and arm; ``points`` is (n_outputs, 2)."""
    return tuple(k for k in range(1, len(points) + 1) if k not in unplaced)


def is_placed(points: Floats, number: int) -> bool:
    """Whether an output is somewhere; ``points`` is (n_outputs, 2)."""
    return number <= len(points) and bool(np.isfinite(points[number - 1]).all())


def output_at(points: Floats, at: QPointF, reach_px: float = _REACH_PX) -> int | None:
    """Number of the output nearest to ``at`` and within reach; ``points`` is (n_outputs, 2), px.

    Those that are nowhere, NaN, are never meant.
    """
    distances = np.hypot(points[:, 0] - at.x(), points[:, 1] - at.y())
    distances[np.isnan(distances)] = np.inf
    nearest = int(np.argmin(distances))
    return nearest + 1 if distances[nearest] <= reach_px else None


def outputs_inside(points: Floats, area: QRectF) -> Outputs:
    """Numbers of the outputs inside ``area``, ascending."""
    x, y = points.T
    inside = (x >= area.left()) & (x <= area.right()) & (y >= area.top()) & (y <= area.bottom())
    return tuple(int(k) + 1 for k in np.flatnonzero(inside))


def output_beyond(points: Floats, number: int, dx: int, dy: int) -> int:
    """The nearest output in a direction of the screen, or ``number`` itself if there is none."""
    steps = points - points[number - 1]
    ahead = steps @ np.array([dx, dy], float)
    aside = np.abs(steps @ np.array([-dy, dx], float))
    # Those within 45 degrees first; then any that lie ahead.
    for reachable in (aside <= ahead, aside < np.inf):
        cost = np.where((ahead > 0.5) & reachable, ahead + 2 * aside, np.inf)
        best = int(np.argmin(cost))
        if np.isfinite(cost[best]):
            return best + 1
    return number


def toggled(outputs: Outputs, number: int) -> Outputs:
    """``outputs`` with ``number`` added at the end, or taken out."""
    if number in outputs:
        return tuple(k for k in outputs if k != number)
    return (*outputs, number)


def joined(outputs: Outputs, more: Outputs) -> Outputs:
    """``outputs`` with those of ``more`` at the end that are new."""
    return (*outputs, *(k for k in more if k not in outputs))


# What the mouse means on the map.

# A press that moves less than this is a click.
_CLICK_PX = 4.0


class OutputMouse(QObject):
    """Turns moves, clicks and rubber bands into outputs.

    Attributes
    ----------
    hovered
        The output under the pointer.
    pointer
        Where the pointer is; ``None`` while it is elsewhere.
    band
        The rubber band, while one is drawn.
    """

    #: The outputs that are meant, whether they are added to the selection.
    meant = Signal(object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.hovered: int | None = None
        self.pointer: QPointF | None = None
        self.band: QRectF | None = None
        self._pressed: QPointF | None = None

    def press(self, at: QPointF) -> None:
        """The left button goes down."""
        self._pressed = at

    def move(self, at: QPointF, points: Floats) -> None:
        """The mouse moves, whether or not the button is held; ``points`` is (n_outputs, 2)."""
        self.pointer = at
        self.hovered = output_at(points, at)
        if self._pressed is not None:
            band = QRectF(self._pressed, at).normalized()
            if self.band is not None or max(band.width(), band.height()) >= _CLICK_PX:
                self.band = band

    def release(self, at: QPointF, points: Floats, outputs: Outputs, *, adds: bool) -> None:
        """The left button goes up; ``adds`` to the present ``outputs``."""
        if self._pressed is None:
            return
        band, self.band, self._pressed = self.band, None, None
        if band is not None:
            inside = outputs_inside(points, band)
            self.meant.emit(joined(outputs, inside) if adds else inside)
            return
        number = output_at(points, at)
        if number is not None:
            self.meant.emit(toggled(outputs, number) if adds else (number,))

    def leave(self) -> None:
        """The pointer is elsewhere, or the keyboard took over."""
        self.pointer = self.hovered = None

    def give_up(self) -> bool:
        """End a press without selecting; return whether there was one."""
        pressed, self._pressed, self.band = self._pressed, None, None
        return pressed is not None


# What keys mean on the map.

#: Held, they add to the selection.
ADDS = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.ControlModifier
_ARROWS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, -1),
    Qt.Key.Key_Down: (0, 1),
}


class OutputKeys(QObject):
    """Moves a cursor from output to output, and selects there.

    Attributes
    ----------
    cursor_output
        Where the cursor is; ``None`` until keys are used.
    used
        Whether keys were used here since the mouse was.
    """

    #: The outputs that are meant.
    meant = Signal(object)
    #: Another output has the cursor.
    moved = Signal()

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.cursor_output: int | None = None
        self.used = False

    def claims(self, event: QKeyEvent) -> bool:
        """Whether a shortcut of the window must not take this key."""
        return bool(meaning_of("skin", event))

    def press(
        self,
        event: QKeyEvent,
        points: Floats,
        unplaced: Outputs,
        outputs: Outputs,
        middle: QPointF,
    ) -> bool:
        """Act on a key; return whether it means anything to outputs.

        Parameters
        ----------
        event
            The press.
        points : (n_outputs, 2)
            Screen places of the outputs.
        unplaced
            Those beside the map.
        outputs
            Those that are selected.
        middle
            Of the map, where the cursor begins.
        """
        wanted = meaning_of("skin", event)
        if wanted == "go":
            place = self._start(points, outputs, middle)
            if self.cursor_output is not None:
                place = output_beyond(points, place, *_ARROWS[Qt.Key(event.key())])
            self.cursor_output = place
            self.moved.emit()
        elif wanted in ("select", "toggle"):
            number = self._start(points, outputs, middle)
            self.cursor_output = number
            self.meant.emit(toggled(outputs, number) if wanted == "toggle" else (number,))
        elif wanted == "select_all":
            self.meant.emit(dorsal_outputs(points, unplaced))
        else:
            return False
        self.used = True
        return True

    def _start(self, points: Floats, outputs: Outputs, middle: QPointF) -> int:
        cursor = () if self.cursor_output is None else (self.cursor_output,)
        here = [number for number in (*cursor, *outputs) if is_placed(points, number)]
        return here[0] if here else output_at(points, middle, float("inf")) or 1


# Which output of a map is pointed at, and which are to be selected.


class OutputPicker(QObject):
    """What the mouse and keys mean on a map whose outputs are selected.

    Attributes
    ----------
    mouse, keys
        What each of them means.
    selected
        The outputs that are selected at present.
    """

    #: The outputs to select, a tuple of numbers.
    chosen = Signal(object)
    #: The cursor of the keyboard is at another output, and counts from now on.
    moved = Signal()

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.mouse, self.keys = OutputMouse(self), OutputKeys(self)
        self.selected: Outputs = ()
        self.mouse.meant.connect(self._choose)
        self.keys.meant.connect(self._choose)
        self.keys.moved.connect(self._follow_cursor)

    def pointed_at(self, *, focused: bool) -> int | None:
        """The output under the pointer; without one, and ``focused``, under the cursor of keys."""
        if self.mouse.pointer is not None:
            return self.mouse.hovered
        return self.keys.cursor_output if focused else None

    def claims(self, event: QKeyEvent) -> bool:
        """Whether a key is wanted here even if it is a shortcut of the window."""
        # Until keys are used here, Space is left to whom the window gives it.
        is_used = self.keys.used or event.key() != Qt.Key.Key_Space
        return is_used and self.keys.claims(event)

    def press(self, event: QMouseEvent) -> None:
        """A button goes down."""
        self.keys.used = False
        if event.button() == Qt.MouseButton.LeftButton:
            self.mouse.press(event.position())

    def release(self, event: QMouseEvent, points: Floats) -> None:
        """The left button goes up; ``points`` is (n_outputs, 2), px."""
        adds = bool(event.modifiers() & ADDS)
        self.mouse.release(event.position(), points, self.selected, adds=adds)

    def press_key(
        self, event: QKeyEvent, points: Floats, unplaced: Outputs, middle: QPointF
    ) -> bool:
        """Act on a key, see `OutputKeys.press`; return whether it means anything to outputs."""
        if meaning_of("skin", event) != "select_none":
            return self.keys.press(event, points, unplaced, self.selected, middle)
        if not self.mouse.give_up():
            self._choose(())
        return True

    def _choose(self, outputs: Outputs) -> None:
        if len(outputs) == 1:
            self.keys.cursor_output = outputs[0]
        if outputs != self.selected:
            self.chosen.emit(outputs)

    def _follow_cursor(self) -> None:
        self.mouse.leave()
        self.moved.emit()
