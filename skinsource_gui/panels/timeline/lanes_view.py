"""The part of the timeline on which clips are moved."""

from collections.abc import Mapping

from PySide6.QtCore import QEvent, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QContextMenuEvent, QHelpEvent, QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QToolTip, QWidget

from skinsource.base.arrays import Floats
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.panels.timeline.clip_lengths import ClipLengths
from skinsource_gui.panels.timeline.content import Content, ruler_px
from skinsource_gui.panels.timeline.gain.gain_item import GainItem
from skinsource_gui.panels.timeline.gain.gain_points import GainPoints
from skinsource_gui.panels.timeline.gestures.gesture import Shown
from skinsource_gui.panels.timeline.hover_words import hover_words
from skinsource_gui.panels.timeline.lane import Lane
from skinsource_gui.panels.timeline.lane_keys import LaneKeys
from skinsource_gui.panels.timeline.lane_mouse import LaneMouse
from skinsource_gui.panels.timeline.lanes_item import LanesItem
from skinsource_gui.panels.timeline.over_item import OverItem
from skinsource_gui.panels.timeline.overlaps import Overlaps
from skinsource_gui.panels.timeline.playhead_item import PlayheadItem
from skinsource_gui.panels.timeline.seen_time import SeenTime
from skinsource_gui.panels.timeline.settings import shown_gain_curves
from skinsource_gui.theme import scaled, tabular
from skinsource_gui.widgets.plot.canvas import Canvas
from skinsource_gui.widgets.time.time_scale import TimeScale
from skinsource_gui.widgets.wheel import NOTCH

_SIDE_PX = 8.0
_TEXT = 0.9
_CTRL = Qt.KeyboardModifier.ControlModifier


class LanesView(Canvas):
    """Lanes and a ruler; tells what the mouse and keys ask for.

    Attributes
    ----------
    mouse, keys
        What is done here.
    item, gains, playhead, over
        What paints.
    gain
        What is done to gain curves.
    seen
        Which part of the time is shown.
    sample_rate_hz
        A free drag goes by whole samples of this rate.
    """

    key_place = "timeline"

    looked = Signal(object)
    #: Lanes are to be scrolled by so many notches.
    scroll_wanted = Signal(float)
    menu_wanted = Signal(object, object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("lanes")
        self.setAccessibleName("Timeline")
        self.setMouseTracking(True)
        self.setMinimumSize(120, 60)
        self.item = LanesItem()
        self.addItem(self.item)
        self.gains, self.playhead, self.over = GainItem(), PlayheadItem(), OverItem()
        self.addItem(self.gains)
        self.addItem(self.playhead)
        self.addItem(self.over)
        self.sample_rate_hz = facts_of("").sample_rate_hz
        self._design, self._view = Design(limb=""), View()
        self._lanes: tuple[Lane, ...] = ()
        self._waveforms: Mapping[int, Floats] = {}
        self._awaited: frozenset[int] = frozenset()
        self._lengths = ClipLengths(self._design)
        self._overlaps = Overlaps()
        self._held_tops: Mapping[int, float] = {}
        self.snaps = True
        self.gain = GainPoints(lambda: self.content, self)
        self.seen = SeenTime(lambda: self.content, self)
        self.content = self._made()
        self.mouse = LaneMouse(lambda: self.content, self.gain, self)
        self.keys = LaneKeys(lambda: self.content, self.gain, self)
        for part in (self.seen, self.gain, self.mouse, self.keys):
            part.looked.connect(self.looked)
        self.gain.chose.connect(self.lay_out)
        self.mouse.shown.connect(self._show_over)
        self._pointer = QPointF()
        self.take_look()

    @property
    def ruler_px(self) -> float:
        """Where lanes begin."""
        return ruler_px(self.fontMetrics().height())

    def show_state(self, design: Design, view: View, lanes: tuple[Lane, ...]) -> None:
        """Show another design or view; lanes in coordinates of this widget."""
        self._design, self._view, self._lanes = design, view, lanes
        self.lay_out()

    def show_playhead(self, view: View) -> None:
        """Show a view in which the playhead alone has moved."""
        self._view = view
        self.content = self.content.with_playhead(view)
        self.playhead.show_content(self.content, float(self.height()))

    def show_waveforms(
        self, waveforms: Mapping[int, Floats], awaited: frozenset[int] = frozenset()
    ) -> None:
        """What clips play, (n_times,) each, by their id; ``awaited``: of which it is late."""
        self._waveforms, self._awaited = waveforms, awaited
        self.lay_out()

    def take_look(self) -> None:
        super().take_look()
        for item in (self.item, self.gains, self.over):
            item.show_font(scaled(tabular(self.font()), _TEXT))

    def set_snaps(self, snaps: bool) -> None:
        """Whether edges snap."""
        self.snaps = snaps
        self.lay_out()

    def claims(self, event: QKeyEvent) -> bool:
        return self.keys.claims(event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        self.seen.hold()
        self._held_tops = {one.lane.track.id: one.top for one in self.content.strips}
        self.mouse.press(event.position(), event.button(), event.modifiers(), self.sample_rate_hz)
        event.accept()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        self._pointer = event.position()
        if self.mouse.busy:
            self.mouse.move(event.position(), event.modifiers())
        else:
            box = self.content.box_at(event.position())
            self.item.show_hovered(None if box is None else box.clip.id)
            self.viewport().setCursor(self.mouse.cursor_at(event.position()))
        event.accept()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if event.button() in (Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton):
            self.mouse.release()
            self._let_go()
        event.accept()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self.mouse.double_click(event.position())
            self._let_go()
        event.accept()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        place = QPointF(event.pos())
        if event.reason() == QContextMenuEvent.Reason.Keyboard:
            # The menu key means the clip that was selected last, or else the playhead.
            place = self.content.place_of_keys
        self.menu_wanted.emit(self.mapToGlobal(place).toPoint(), place)

    def wheelEvent(self, event: QWheelEvent) -> None:
        turns, held = event.angleDelta(), event.modifiers()
        if turns.x() or held & (_CTRL | Qt.KeyboardModifier.ShiftModifier):
            self.seen.turn(event)
        else:
            self.scroll_wanted.emit(turns.y() / NOTCH)
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.mouse.cancel():
            self._let_go()
        elif not self.keys.press(event):
            event.ignore()

    def viewportEvent(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            QToolTip.showText(
                event.globalPos(), hover_words(self.content, QPointF(event.pos())), self
            )
            return True
        return super().viewportEvent(event)

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self.item.show_hovered(None)

    def _let_go(self) -> None:
        self.seen.let_go()
        self._held_tops = {}
        self.lay_out()

    def _show_over(self, shown: Shown) -> None:
        self.over.show_over(shown, self._pointer)

    def lay_out(self) -> None:
        self.content = self._made()
        rect = QRectF(self.rect())
        for item in (self.item, self.gains, self.over):
            item.show_content(self.content, rect)
        self.setAccessibleDescription(self.gain.words())
        self.playhead.show_content(self.content, float(self.height()))

    def _made(self) -> Content:
        self._lengths = self._lengths.of(self._design)
        shown_s = self.seen.range_s(self._view, self._lengths.whole_s)
        width = max(self.width() - 2 * _SIDE_PX, 1.0)
        return Content(
            design=self._design,
            view=self._view,
            lanes=self._lanes,
            scale=TimeScale(shown_s=shown_s, left_px=_SIDE_PX, width_px=width),
            height_px=float(self.height()),
            lengths=self._lengths,
            waveforms=self._waveforms,
            awaited=self._awaited,
            sample_rate_hz=self.sample_rate_hz,
            snaps=self.snaps,
            ruler_px=self.ruler_px,
            gain_shown=shown_gain_curves(self._view),
            gain_tops=self._held_tops,
            chosen_point=self.gain.chosen,
            overlaps=self._overlaps,
        )
