"""What the mouse means on the hand diagram."""

from dataclasses import dataclass

from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication, QWidget

from skinsource_gui.panels.hand.hand_stage import HandStage
from skinsource_gui.panels.hand.hand_state import Mark
from skinsource_gui.widgets.fields.gesture import new_gesture

_LEFT = Qt.MouseButton.LeftButton
_TOGGLE = (Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier)
_FURTHER = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.ControlModifier


@dataclass(slots=True, kw_only=True)
class _Press:
    """The left button, held since it went down on a site, and the drag that this became.

    ``index`` is the input it is about, ``target`` the site which that input was sent to last.
    """

    site: int
    at: QPointF
    index: int | None
    was_selected: bool
    toggles: bool
    further: bool
    target: int
    gesture: int | None = None


class SiteMouse(QObject):
    """Turns presses, moves and releases on a hand into what they mean.

    A press selects an input, or at release places one; with Ctrl or Shift it adds an input, a new
    one too, to the selected ones or takes it out, with both it places one more on a site that has
    one.  Moving
    farther drags the input, live, in one gesture.  Dropped far from every site, or cancelled, it
    goes back where it came from.

    Parameters
    ----------
    stage
        The hand; its hover, ghost and target are changed here.
    widget
        Where it is; its cursor is changed here.
    """

    #: Site on which the button went down.
    pressed = Signal(int)
    #: Site of a new input.
    placed = Signal(int)
    #: Site of a new input that is selected besides those that are.
    placed_besides = Signal(int)
    #: Number of an input.
    selected = Signal(int)
    toggled = Signal(int)
    #: Number of an input, its new site, gesture.
    moved = Signal(int, int, int)

    def __init__(self, stage: HandStage, widget: QWidget) -> None:
        super().__init__(widget)
        self._stage, self._widget = stage, widget
        self._press: _Press | None = None

    @property
    def busy(self) -> bool:
        """Whether the button is held on a site."""
        return self._press is not None

    def press(self, event: QMouseEvent) -> None:
        """The left button goes down."""
        self.cancel()  # a release that never came
        site = self._stage.site_at(event.position())
        if site is None:
            return
        state = self._stage.state
        held = event.modifiers() & _FURTHER
        front = state.front_at(site)
        press = _Press(
            site=site,
            at=event.position(),
            index=front,
            was_selected=front is not None and front == state.selected,
            toggles=held in _TOGGLE,
            further=held == _FURTHER,
            target=site,
        )
        self._press = press
        self.pressed.emit(site)
        if front is not None and not press.was_selected and not held:
            self.selected.emit(front)

    def move(self, event: QMouseEvent) -> None:
        """The mouse moves, whether or not the button is held."""
        press = self._press
        if press is None or not event.buttons() & _LEFT:
            self.hover(self._stage.site_at(event.position()))
        elif press.index is not None and not (press.further or press.toggles):
            way = (event.position() - press.at).manhattanLength()
            if press.gesture is None and way >= QApplication.startDragDistance():
                press.gesture = new_gesture()
                self._widget.setCursor(Qt.CursorShape.ClosedHandCursor)
            if press.gesture is not None:
                self._drag(press, event.position())

    def release(self, event: QMouseEvent) -> None:
        """The left button goes up."""
        press, self._press = self._press, None
        site = self._stage.site_at(event.position())
        if press is not None and press.gesture is not None:
            self._drop()
        elif press is not None and site == press.site:
            self._click(press)
        self.hover(site)

    def hover(self, site: int | None) -> None:
        """Show which site is under the mouse."""
        self._stage.change(hovered=site)
        if site is None:
            self._widget.unsetCursor()
        elif self._stage.state.at(site):
            self._widget.setCursor(Qt.CursorShape.OpenHandCursor)
        else:
            self._widget.setCursor(Qt.CursorShape.PointingHandCursor)

    def cancel(self) -> None:
        """Send what is being dragged back where it came from."""
        press, self._press = self._press, None
        if press is not None:
            self._drop()
            self._send(press, press.site)

    def check(self, marks: tuple[Mark, ...]) -> None:
        """End the drag if these inputs are not the ones it began with, by an undo perhaps."""
        press = self._press
        if press is None or press.index is None:
            return
        lost = press.index >= len(marks)
        if lost or marks[press.index].site not in (press.site, press.target):
            self._press = None
            self._drop()

    def _drag(self, press: _Press, position: QPointF) -> None:
        hand = self._stage.layout
        ghost = position + hand.centre(press.site) - press.at
        target = hand.site_to_snap_to(ghost) or press.site
        self._stage.change(hovered=None, moving=press.index, ghost=ghost, target=target)
        self._send(press, target)

    def _drop(self) -> None:
        self._stage.change(moving=None, ghost=None, target=None)
        self._widget.unsetCursor()

    def _send(self, press: _Press, site: int) -> None:
        if site != press.target and press.index is not None and press.gesture is not None:
            press.target = site
            self.pressed.emit(site)
            self.moved.emit(press.index, site, press.gesture)

    def _click(self, press: _Press) -> None:
        if press.index is None or press.further:
            (self.placed_besides if press.toggles else self.placed).emit(press.site)
            return
        if press.toggles:
            self.toggled.emit(press.index)
            return
        following = self._stage.state.next_at(press.site)
        if press.was_selected and following not in (None, press.index):
            self.selected.emit(following)
