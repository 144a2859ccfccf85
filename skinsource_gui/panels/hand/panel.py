"""The hand panel: inputs are placed, moved and removed on a hand, by mouse or keyboard."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, ClassVar

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, QSize, Qt, QTimer, Signal

from skinsource.base.errors import quoted
from skinsource.design import edits
from skinsource.design.design import Design, Input, View, audible_inputs
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.limbs.limb import Limb
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.fields.editor import new_gesture
from skinsource_gui.fields.inputs import EMPTY, fill_inputs_menu, remove_selected
from skinsource_gui.panels.hand.picture import (
    HAND,
    HandDrawing,
    HandSettings,
    HandStage,
    HandState,
    Mark,
    PlacesOfMap,
    drawing_of,
    places_of_map,
)
from skinsource_gui.qt.accessible import Told
from skinsource_gui.qt.buttons import page_label, passing_menu, tool_button
from skinsource_gui.qt.frames import DropPlace, paint_focus_frame
from skinsource_gui.qt.keys import claims_shortcut, key_text, meaning_of
from skinsource_gui.qt.layouts import named
from skinsource_gui.qt.theme import current_theme
from skinsource_gui.qt.wheel import WHOLE
from skinsource_gui.state.panel import Panel

#: Two digits that are typed within this time make one number, ms.
TYPING_MS = 800

_PLACE = "hand"
_Key = Qt.Key
_STEPS = {
    _Key.Key_Left: (-1, 0),
    _Key.Key_Right: (1, 0),
    _Key.Key_Up: (0, -1),
    _Key.Key_Down: (0, 1),
}
_DIGITS = {_Key(_Key.Key_0 + digit): digit for digit in range(10)}


class SiteCursor:
    """The keyboard's cursor: it goes from site to site of a hand, and acts there.

    A number of several digits may be typed; all Shift+arrow presses until Shift is let go are one
    gesture.

    Attributes
    ----------
    site
        Where it is, whether or not it is shown.
    """

    def __init__(self, hand: "HandDiagram") -> None:
        self._hand, self._stage = hand, hand.stage
        self.site = 1
        self._typed = 0
        self._gesture: int | None = None
        self._pause = QTimer(hand, singleShot=True, interval=TYPING_MS)
        self._pause.setObjectName("typing")
        self._pause.timeout.connect(self._forget_digits)

    def show_hand(self) -> None:
        """Take over another hand, which may have no site where the cursor is."""
        self._forget_digits()
        if not self._stage.layout.has(self.site):
            self.site = 1
        self._hand.describe(self.site)

    def keep_up(self, before: HandState, *, anew: bool, focused: bool) -> None:
        """Follow a change of the inputs ``before``; see `HandDiagram.show_inputs`."""
        state = self._stage.state
        site = state.selected_site
        if site is not None and state.selected != before.selected and not focused:
            self.follow(site)
        elif site is not None and anew and site != before.selected_site:
            # It is another design: the cursor would name a place of the old one.
            (self.follow if before.cursor is None else self.go_to)(site)
        else:
            self._hand.describe(self.site)

    def follow(self, site: int) -> None:
        """Go to a site that the mouse used, without showing the cursor."""
        if not self._stage.layout.has(site):
            return
        self.site = site
        self._hand.describe(site)

    def go_to(self, site: int) -> None:
        """Go to a site and show the cursor there."""
        if not self._stage.layout.has(site):
            return
        self.follow(site)
        self._stage.change(cursor=site)
        self._stage.pan_zoom.reveal(self._stage.layout.centre(site))

    def press(self, event: QtGui.QKeyEvent) -> bool:
        """Do what a key means; return whether it means anything."""
        meaning, key = meaning_of(_PLACE, event), _Key(event.key())
        if meaning == "move":
            self._gesture = self._gesture or new_gesture()
            self._shift(_STEPS[key], self._gesture)
        elif meaning == "go":
            self.go_to(self._stage.layout.neighbour(self.site, _STEPS[key]))
        elif meaning == "jump" and key in _DIGITS:
            self._type(_DIGITS[key])
        elif meaning == "jump":
            self.go_to(1 if key == _Key.Key_Home else self._stage.layout.n_sites)
        elif meaning == "remove":
            self._hand.remove_requested.emit()
        elif meaning == "select_all":
            self._hand.all_requested.emit()
        elif meaning:
            self._activate(meaning == "place_another")
        return bool(meaning)

    def release(self, event: QtGui.QKeyEvent) -> None:
        """End the gesture when Shift is released."""
        if event.key() == _Key.Key_Shift:
            self.end_gesture()

    def end_gesture(self) -> None:
        """Make the next Shift+arrow press an undo step of its own."""
        self._gesture = None

    def _type(self, digit: int) -> None:
        number = 10 * self._typed + digit
        self._typed = number if number <= self._stage.layout.n_sites else digit
        self._pause.start()
        if self._typed:
            self.go_to(self._typed)

    def _forget_digits(self) -> None:
        self._typed = 0

    def _activate(self, further: bool) -> None:
        self.go_to(self.site)
        following = self._stage.state.next_at(self.site)
        if further or following is None:
            self._hand.add_requested.emit(self.site, False)
        else:
            self._hand.select_requested.emit(following)

    def _shift(self, direction: tuple[int, int], gesture: int) -> None:
        state = self._stage.state
        if state.selected is None:
            return
        origin = state.marks[state.selected].site
        if not self._stage.layout.has(origin):
            # An input from outside of the hand comes to the cursor.
            self._hand.move_requested.emit(state.selected, self.site, gesture)
            return
        site = self._stage.layout.neighbour(origin, direction)
        if site != origin:
            self._hand.move_requested.emit(state.selected, site, gesture)
        self.go_to(site)


_LEFT = Qt.MouseButton.LeftButton
_TOGGLE = (Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier)
_FURTHER = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.ControlModifier


@dataclass(slots=True, kw_only=True)
class _Press:
    """A press of the left button on a site, and the drag that it became.

    ``index`` is the pressed input, ``target`` the site to which it was moved last.
    """

    site: int
    at: QPointF
    index: int | None
    was_selected: bool
    toggles: bool
    further: bool
    target: int
    gesture: int | None = None


class SiteMouse:
    """Translates mouse presses, moves and releases on a hand into actions.

    A press selects an input, or at release places one; with Ctrl or Shift it adds an input, a new
    one too, to the selected ones or takes it out, with both it places one more on a site that has
    one.  Moving farther drags the input, live, in one gesture.  Dropped far from every site, or
    cancelled, it goes back where it came from.

    Parameters
    ----------
    hand
        The hand; its mouse cursor, hover, ghost and target are changed here.
    """

    def __init__(self, hand: "HandDiagram") -> None:
        self._hand, self._stage = hand, hand.stage
        self._press: _Press | None = None

    @property
    def busy(self) -> bool:
        """Whether the button is held on a site."""
        return self._press is not None

    def press(self, event: QtGui.QMouseEvent) -> None:
        """Handle a press of the left button."""
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
        self._hand.site_cursor.follow(site)
        if front is not None and not press.was_selected and not held:
            self._hand.select_requested.emit(front)

    def move(self, event: QtGui.QMouseEvent) -> None:
        """Handle a move of the mouse, whether or not the button is held."""
        press = self._press
        if press is None or not event.buttons() & _LEFT:
            self.hover(self._stage.site_at(event.position()))
        elif press.index is not None and not (press.further or press.toggles):
            way = (event.position() - press.at).manhattanLength()
            if press.gesture is None and way >= QtWidgets.QApplication.startDragDistance():
                press.gesture = new_gesture()
                self._hand.setCursor(Qt.CursorShape.ClosedHandCursor)
            if press.gesture is not None:
                self._drag(press, event.position())

    def release(self, event: QtGui.QMouseEvent) -> None:
        """Handle a release of the left button."""
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
            self._hand.unsetCursor()
        elif self._stage.state.at(site):
            self._hand.setCursor(Qt.CursorShape.OpenHandCursor)
        else:
            self._hand.setCursor(Qt.CursorShape.PointingHandCursor)

    def cancel(self) -> None:
        """Send a dragged input back to where it came from."""
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
        self._hand.unsetCursor()

    def _send(self, press: _Press, site: int) -> None:
        if site != press.target and press.index is not None and press.gesture is not None:
            press.target = site
            self._hand.site_cursor.follow(site)
            self._hand.move_requested.emit(press.index, site, press.gesture)

    def _click(self, press: _Press) -> None:
        if press.index is None or press.further:
            self._hand.add_requested.emit(press.site, press.toggles)
            return
        if press.toggles:
            self._hand.toggle_requested.emit(press.index)
            return
        following = self._stage.state.next_at(press.site)
        if press.was_selected and following is not None:
            self._hand.select_requested.emit(following)


# Reasons of a focus change without a use of the keyboard here.
_BY_MOUSE = (
    Qt.FocusReason.MouseFocusReason,
    Qt.FocusReason.ActiveWindowFocusReason,
    Qt.FocusReason.PopupFocusReason,
)


class HandDiagram(QtWidgets.QWidget):
    """A palm with its sites; signals tell what the user does there.

    Parameters
    ----------
    drawing
        The hand.

    Attributes
    ----------
    stage, site_cursor
        What is shown, and where; the cursor of the keyboard.
    """

    #: Site of a new input, and whether what is selected stays so besides.
    add_requested = Signal(int, bool)
    #: Number of an input.
    select_requested = Signal(int)
    #: Number of an input that is to be added to the selected ones, or taken out.
    toggle_requested = Signal(int)
    all_requested = Signal()
    #: Number of an input, its new site, gesture.
    move_requested = Signal(int, int, int)
    #: The selected clips shall be removed, or else the selected inputs.
    remove_requested = Signal()
    #: Site, position on the screen.
    menu_requested = Signal(int, QPoint)
    #: The place of the drawing under the pointer, (x, y), or None.
    place_pointed_at = Signal(object)

    def __init__(self, drawing: HandDrawing, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.stage = HandStage(drawing, self)
        self.stage.changed.connect(self.update)
        self._mouse, self.site_cursor = SiteMouse(self), SiteCursor(self)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        named(self, "hand_diagram", "Hand, palm side")
        self.describe(self.site_cursor.site)

    def site_centre(self, site: int) -> QPoint:
        """Return the middle of a site's marker, in pixels of this widget."""
        return self.stage.layout.centre(site).toPoint()

    def told_count(self) -> int:
        """Return the number of places."""
        return self.stage.layout.n_sites

    def told(self, k: int) -> Told:
        """Return what a screen reader says of a place."""
        site, marks = k + 1, self.stage.state.marks
        chosen = any(marks[index].chosen for index in self.stage.state.at(site))
        name = self.stage.text(site).replace("\n", ". ").replace(", selected", "")
        return Told(f"Place {name}", self.stage.layout.marker_area(site), chosen)

    def show_drawing(self, drawing: HandDrawing) -> None:
        """Take another hand."""
        if drawing is not self.stage.drawing:
            self._mouse.cancel()
            self.stage.show_drawing(drawing, self)
            self.site_cursor.show_hand()

    def show_inputs(
        self, marks: tuple[Mark, ...], selected: int | None, *, anew: bool = False
    ) -> None:
        """Show these inputs, of which ``selected`` is the selected one.

        ``anew`` says that none of them is as one was before.
        """
        before = self.stage.state
        self._mouse.check(marks)
        self.stage.change(marks=marks, selected=selected)
        self.site_cursor.keep_up(before, anew=anew, focused=self.hasFocus())

    def minimumSizeHint(self) -> QSize:
        return QSize(150, 190)

    def sizeHint(self) -> QSize:
        return QSize(320, 400)

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self.stage.fit(self)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self.stage.fit(self)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        self.stage.paint(painter, self.devicePixelRatioF())
        if self.hasFocus():
            # The frame shows that keys act here; the ring shows where, once they are used.
            paint_focus_frame(painter, QRectF(self.rect()), current_theme())

    def wheelEvent(self, event: QtGui.QWheelEvent) -> None:
        self.stage.pan_zoom.wheel(event)

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        self.stage.change(cursor=None)
        self.stage.pan_zoom.press(event)
        if event.button() == Qt.MouseButton.LeftButton:
            self._mouse.press(event)

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        self.stage.pan_zoom.move(event)
        self._mouse.move(event)
        stage = self.stage
        point = stage.layout.transform.inverted()[0].map(event.position())
        at: tuple[float, float] | None = (point.x(), point.y())
        if stage.drawing.contacts and stage.state.hovered is not None:
            # The sign of a contact along a digit lies off its place.
            x, y = stage.drawing.anchors[stage.state.hovered - 1]
            at = float(x), float(y)
        elif not stage.drawing.outline.contains(point):
            at = None
        self.place_pointed_at.emit(at)

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        self.stage.pan_zoom.release(event)
        if event.button() == Qt.MouseButton.LeftButton:
            self._mouse.release(event)

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:
        if self.stage.site_at(event.position()) is None:
            self.stage.pan_zoom.show(WHOLE)
        else:
            self.mousePressEvent(event)

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self._mouse.hover(None)
        self.place_pointed_at.emit(None)

    def hideEvent(self, event: QtGui.QHideEvent) -> None:
        super().hideEvent(event)
        self._mouse.cancel()

    def contextMenuEvent(self, event: QtGui.QContextMenuEvent) -> None:
        if event.reason() == QtGui.QContextMenuEvent.Reason.Keyboard:
            site: int | None = self.site_cursor.site
            at = self.mapToGlobal(self.site_centre(self.site_cursor.site))
        else:
            site = self.stage.site_at(QPointF(event.pos()))
            at = event.globalPos()
        if site is None or self._mouse.busy:
            event.ignore()
            return
        self.site_cursor.site = site
        front = self.stage.state.front_at(site)
        if front is not None and not self.stage.state.marks[front].chosen:
            self.select_requested.emit(front)
        self.menu_requested.emit(site, at)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self._mouse.busy:
            self._mouse.cancel()
        elif self._mouse.busy or not self.site_cursor.press(event):
            super().keyPressEvent(event)

    def keyReleaseEvent(self, event: QtGui.QKeyEvent) -> None:
        self.site_cursor.release(event)
        super().keyReleaseEvent(event)

    def focusInEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusInEvent(event)
        self.update()
        if event.reason() not in _BY_MOUSE:
            self.site_cursor.go_to(self.site_cursor.site)

    def focusOutEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.update()
        self.site_cursor.end_gesture()
        if event.reason() != Qt.FocusReason.PopupFocusReason:
            self.stage.change(cursor=None)

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QtGui.QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            site = self.stage.site_at(QPointF(event.pos()))
            if site is None or self.stage.state.moving is not None:
                QtWidgets.QToolTip.hideText()
            else:
                area = self.stage.layout.marker_area(site).toAlignedRect()
                QtWidgets.QToolTip.showText(event.globalPos(), self.stage.text(site), self, area)
            return True
        return claims_shortcut(event, self._overrides) or super().event(event)

    def _overrides(self, event: QtGui.QKeyEvent) -> bool:
        """Return whether a key is handled here even if it is a shortcut of the window."""
        if event.key() == Qt.Key.Key_Escape:
            return self._mouse.busy
        # Until keys are used here, Space belongs to the window.
        if event.key() == Qt.Key.Key_Space and self.stage.state.cursor is None:
            return False
        return bool(meaning_of(_PLACE, event))

    def describe(self, site: int) -> None:
        """Say what is at a site to assistive technology."""
        self.setAccessibleDescription(self.stage.description(site))


class HandPanel(Panel):
    """Places inputs on the hand, moves and removes them; shows nothing computed.

    Attributes
    ----------
    diagram, mirror
        The hand; the switch that shows the palm through the hand.
    """

    title: ClassVar[str] = "Hand"
    name: ClassVar[str] = HAND
    needs = frozenset({"limb_data"})

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        # Ids of the inputs that are pointed at here, and in another panel.
        self._pointed_at: int | None = None
        self._elsewhere: int | None = None
        self.diagram = HandDiagram(drawing_of(""), self)
        self.diagram.add_requested.connect(partial(self._edit, edits.place_input))
        self.diagram.select_requested.connect(self._select)
        self.diagram.move_requested.connect(self._move)
        self.diagram.toggle_requested.connect(self._toggle)
        self.diagram.all_requested.connect(partial(self._edit, edits.select_all_inputs))
        self.diagram.remove_requested.connect(partial(self._edit, remove_selected))
        self.diagram.menu_requested.connect(self._open_menu)
        self.diagram.stage.changed.connect(self._follow_pointer)
        self.diagram.place_pointed_at.connect(self._point_at_place)
        self._limb: Limb | None = None
        hint = "Palm seen through the hand, as on the map"
        self.mirror = tool_button(self.diagram, "hand_mirror", "⇄", hint, checkable=True)
        self.mirror.setAccessibleName("Mirror")
        self.mirror.move(4, 4)
        self.mirror.clicked.connect(self._mirror)
        # The hand of a missing limb is unknown, and another hand has other places.
        self._missing = page_label("hand_missing", tone="dim", centred=True)
        self._stack = QtWidgets.QStackedLayout(self)
        self._stack.addWidget(self.diagram)
        self._stack.addWidget(self._missing)
        self.setFocusProxy(self.diagram)

    def show_state(self, design: Design, view: View) -> None:
        before = self._design.inputs
        shown = self._design.limb, self._view.selected_inputs, len(before)
        self._design, self._view = design, view
        if self._elsewhere is not None and self.diagram.stage.state.moving is None:
            # The input may have moved.
            self.show_pointed_input(self._elsewhere)
        missing = facts_of(design.limb).missing
        if missing:
            self._missing.setText(f"The limb {quoted(design.limb)} is missing")
        else:
            through = settings_of(view, self.name, HandSettings).mirrored
            self.mirror.setChecked(through)
            self.diagram.show_drawing(drawing_of(design.limb, through=through))
        self._stack.setCurrentWidget(self._missing if missing else self.diagram)
        both = zip(before, design.inputs, strict=False)
        if shown != (design.limb, view.selected_inputs, len(design.inputs)) or any(
            old is not new and _look(old) != _look(new) for old, new in both
        ):
            self._show_inputs(anew=set(map(id, before)).isdisjoint(map(id, design.inputs)))

    def show_pointed_input(self, input_id: int | None) -> None:
        self._elsewhere = input_id
        tracks = self._design.inputs
        site = next((track.location for track in tracks if track.id == input_id), None)
        self.diagram.stage.change(target=site)

    def show_results(self, results: Mapping[str, Any]) -> None:
        self._limb = results["limb_data"]

    def show_pointed_place(self, at: tuple[float, float] | None) -> None:
        places = self._places()
        ring = None if at is None or places is None else places.on_drawing(at)
        self.diagram.stage.change(ring=ring)

    def _point_at_place(self, at: tuple[float, float] | None) -> None:
        places = self._places()
        self.diagram.stage.change(ring=at if self.diagram.stage.state.hovered is None else None)
        self.place_pointed_at.emit(None if at is None or places is None else places.on_map(at))

    def _places(self) -> PlacesOfMap | None:
        """Return where places of the map lie on this hand, once its map is known."""
        if self._limb is None or self._limb.name != self._design.limb:
            return None
        return places_of_map(self.diagram.stage.drawing, self._limb.map)

    def _mirror(self, mirrored: bool) -> None:
        settings = replace(settings_of(self._view, self.name, HandSettings), mirrored=mirrored)
        self.view_changed.emit(with_settings(self._view, self.name, settings))

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._show_inputs()

    def drop_place(self, at: QPoint) -> DropPlace | None:
        if self._stack.currentWidget() is not self.diagram:
            return DropPlace()
        position = QPointF(self.diagram.mapFrom(self, at))
        return DropPlace(location=self.diagram.stage.layout.site_to_snap_to(position))

    def show_drop(self, at: QPoint | None) -> None:
        place = None if at is None else self.drop_place(at)
        self.diagram.stage.change(target=None if place is None else place.location)

    def _follow_pointer(self) -> None:
        """Tell other panels which input the mouse points at."""
        state = self.diagram.stage.state
        index = None if state.hovered is None else state.front_at(state.hovered)
        ids = () if index is None else self._ids_at(index)
        pointed_at = ids[0] if ids else None
        if pointed_at != self._pointed_at:
            self._pointed_at = pointed_at
            self.input_pointed_at.emit(pointed_at)

    def _show_inputs(self, *, anew: bool = False) -> None:
        """Show the inputs; ``anew``: none of them is as one was before."""
        audible = {id(track) for track in audible_inputs(self._design.inputs)}
        marks = tuple(
            Mark(
                site=track.location,
                colour=current_theme().input_colour(track.colour),
                silent=id(track) not in audible,
                text=_text(track),
                chosen=track.id in self._view.selected_inputs,
            )
            for track in self._design.inputs
        )
        self.diagram.show_inputs(marks, self._selected(), anew=anew)

    def _selected(self) -> int | None:
        """Return the index of the input that was selected last, if the design still has it."""
        ids, last = self._design.ids, self._view.selected_input
        return ids.index(last) if last in ids else None

    def _select(self, index: int) -> None:
        self._edit(edits.select_inputs, self._ids_at(index))

    def _toggle(self, index: int) -> None:
        for track_id in self._ids_at(index):
            self._edit(edits.toggle_selected, track_id)

    def _move(self, index: int, site: int, gesture: int) -> None:
        self._edit(edits.move_inputs, self._ids_at(index), site, gesture=gesture)

    def _ids_at(self, index: int) -> tuple[int, ...]:
        """Return the id of an input; empty where the design has lost it, by an undo perhaps."""
        return self._design.ids[index : index + 1]

    def _edit(
        self, edit: Callable[..., Edit | Refusal], *arguments: object, gesture: int | None = None
    ) -> None:
        self.edited.emit(edit(self._design, self._view, *arguments), gesture)

    def _open_menu(self, site: int, at: QPoint) -> None:
        index = self.diagram.stage.state.front_at(site)
        menu = passing_menu(self, "hand_menu")
        add = f"Add input here\t{key_text('hand', 'place_another')}"
        menu.addAction(add, lambda: self._edit(edits.place_input, site))
        menu.addSeparator()
        ids = () if index is None else self._ids_at(index)
        if ids and self._view.selected_clips:
            # Keys act on what the menu acts on.
            self._edit(edits.select_inputs, ids)
        if set(ids) & set(self._view.selected_inputs):
            ids = self._view.selected_inputs
        chosen = [track for track in self._design.inputs if track.id in ids]
        fill_inputs_menu(menu, chosen, lambda edit: self._edit(edit, ids), place="hand")
        menu.popup(at)


def _look(track: Input) -> tuple[object, ...]:
    return track.id, track.location, track.colour, _text(track)


def _text(track: Input) -> str:
    """Return the kinds of waveform that an input plays, three at most, and whether it is heard."""
    titles = list(dict.fromkeys(clip.waveform.title for clip in track.clips)) or [EMPTY]
    more = {"…": len(titles) > 3, "muted": track.muted, "solo": track.solo}
    return ", ".join([*titles[:3], *(word for word, holds in more.items() if holds)])
