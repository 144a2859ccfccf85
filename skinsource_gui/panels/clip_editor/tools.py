"""The tools of the clip editor: a pointer that reads values, a pen, and curves of breakpoints."""

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from math import hypot

import numpy as np
from pyqtgraph.functions import arrayToQPath
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, QPointF, QRectF, Qt, Signal

from skinsource.base.conventions import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.design.display_units import value_text
from skinsource.design.edits.cutting import faded_ends
from skinsource.design.effects import breakpoints as algebra
from skinsource.design.effects.breakpoints import Points
from skinsource.signals.synthesis import Column, Stroke, drawn_over, zeroed
from skinsource.specs.breakpoints import SEGMENTS, Breakpoint, Segment
from skinsource_gui.fields.curve_field import fill_ground_menu, fill_point_menu
from skinsource_gui.fields.editor import new_gesture
from skinsource_gui.panels.clip_editor.view import REACH, Button, EditorContent, Modifier, Tool
from skinsource_gui.plots.ranges import linear_ticks, number_text
from skinsource_gui.qt.frames import paint_card
from skinsource_gui.qt.theme import Theme


@dataclass(frozen=True, slots=True, kw_only=True)
class CurveStyle:
    """How a curve is painted and named.

    Attributes
    ----------
    colour
        Name of a colour in a theme.
    mirrored
        Whether it is painted upside down too, as an envelope is around a waveform.
    label, unit
        Label and unit of the values.
    highest
        The largest value.
    bends
        Whether a segment may be smooth, or held.
    how
        How to begin, while there is only the first point.
    """

    colour: str = "warning"
    mirrored: bool = True
    label: str = ""
    unit: str = ""
    highest: float = algebra.HIGHEST
    bends: bool = True
    how: str = ""


_POINT_PX, _HOVERED_PX = 3.5, 5.0


def paint_points(
    painter: QtGui.QPainter,
    places: tuple[Floats, Floats],
    chosen: Collection[int],
    hovered: int | None,
    style: CurveStyle,
    theme: Theme,
) -> None:
    """Paint points at places in px, (n_points,) each; the chosen ones are filled."""
    x, y = places
    colour = getattr(theme, style.colour)
    painter.setPen(QtGui.QPen(QtGui.QColor(colour), 1.5))
    for index, place in enumerate(map(QPointF, x.tolist(), y.tolist())):
        radius = _HOVERED_PX if index == hovered else _POINT_PX
        painter.setBrush(QtGui.QColor(theme.accent if index in chosen else theme.base))
        painter.drawEllipse(place, radius, radius)


def write_point(
    painter: QtGui.QPainter,
    content: EditorContent,
    point: Breakpoint,
    style: CurveStyle,
    theme: Theme,
) -> None:
    """Write where a point is, above it, on ground of its own."""
    time_s, value, kind = point
    when = value_text(time_s, "s", digits=5)
    if style.bends:
        text = f"{when} · {number_text(value, 3)} · {kind}"
    else:
        text = f"{style.label} · {when} · {value:.5g} {style.unit}".rstrip()
    at, area = content.at(time_s, value), content.area
    line = QtGui.QFontMetricsF(painter.font())
    width, height = line.horizontalAdvance(text) + 12, line.height() + 4
    left = min(max(at.x() - width / 2, area.left() + 2), area.right() - width - 2)
    # Below the point where there is no room above it.
    top = at.y() - height - 10 if at.y() - height - 10 > area.top() else at.y() + 10
    room = QRectF(left, top, width, height)
    paint_card(painter, room, text, theme)


#: Distance within which the pointer catches a handle, px.
CATCH_PX = 6.0
# Between the outermost points and the box, so that points and handles do not cover each other.
_BOX_GAP_PX = 14.0
_HANDLE_PX = 6.0
_SIDES = ((-1, 0), (1, 0), (0, -1), (0, 1), (-1, -1), (-1, 1), (1, -1), (1, 1))


@dataclass(frozen=True, slots=True)
class Handle:
    """A side or a corner: -1 is left or below, 1 right or above, 0 neither."""

    along: int
    up: int


def handle_at(
    content: EditorContent, points: Points, chosen: tuple[int, ...], at: QPointF
) -> Handle | None:
    """Return the handle within reach."""
    for handle, place in _handles(content, points, chosen):
        if hypot(place.x() - at.x(), place.y() - at.y()) <= CATCH_PX:
            return handle
    return None


def scaled_by(
    points: Points, chosen: tuple[int, ...], handle: Handle, by_s: float, by_value: float
) -> Points:
    """Return the points after a handle was dragged; what is opposite to it stays.

    Points of the same value are scaled about 0.
    """
    times, values = _places(points, chosen)
    from_s, factor_s = _fixed_and_factor(min(times), max(times), handle.along, by_s)
    low, high = min(values), max(values)
    from_value, factor = _fixed_and_factor(0.0 if low == high else low, high, handle.up, by_value)
    return algebra.scaled(points, chosen, (from_s, from_value), factor_s, factor)


def paint_box(
    painter: QtGui.QPainter,
    content: EditorContent,
    points: Points,
    chosen: tuple[int, ...],
    theme: Theme,
) -> None:
    """Paint the box and its handles, where there is more than one point to scale."""
    box = _box(content, points, chosen)
    if box is None:
        return
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.accent), 1, Qt.PenStyle.DashLine))
    painter.drawRect(box)
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.accent), 1))
    painter.setBrush(QtGui.QColor(theme.base))
    for _, place in _handles(content, points, chosen):
        square = QRectF(0, 0, _HANDLE_PX, _HANDLE_PX)
        square.moveCenter(place)
        painter.drawRect(square)


def _fixed_and_factor(low: float, high: float, side: int, by: float) -> tuple[float, float]:
    """Return what stays, and the factor, when one side of a range is dragged."""
    if side == 0 or low == high:
        return low, 1.0
    stays = low if side > 0 else high
    return stays, max(1.0 + side * by / (high - low), 0.0)


def _places(points: Points, chosen: tuple[int, ...]) -> tuple[list[float], list[float]]:
    """Return times and values of the chosen points."""
    places = [points[k] for k in chosen if k < len(points)]
    return [point[0] for point in places], [point[1] for point in places]


def _box(content: EditorContent, points: Points, chosen: tuple[int, ...]) -> QRectF | None:
    times, values = _places(points, chosen)
    if len(times) < 2:
        return None
    places = list(map(content.at, times, values))
    x, y = [place.x() for place in places], [place.y() for place in places]
    tight = QRectF(QPointF(min(x), min(y)), QPointF(max(x), max(y)))
    box = tight.adjusted(-_BOX_GAP_PX, -_BOX_GAP_PX, _BOX_GAP_PX, _BOX_GAP_PX)
    # All handles stay visible.
    return box.intersected(content.area.adjusted(3, 3, -3, -3))


def _handles(
    content: EditorContent, points: Points, chosen: tuple[int, ...]
) -> list[tuple[Handle, QPointF]]:
    box = _box(content, points, chosen)
    if box is None or box.isEmpty():
        return []
    times, values = map(set, _places(points, chosen))
    handles = []
    for along, up in _SIDES:
        # Points of the same time have no width to scale, those of the same value only upwards.
        if (along and len(times) == 1) or (up < 0 and len(values) == 1):
            continue
        if up and values == {0.0}:
            continue
        x = box.center().x() + along * box.width() / 2
        y = box.center().y() - up * box.height() / 2
        handles.append((Handle(along, up), QPointF(x, y)))
    return handles


@dataclass(slots=True)
class Drag:
    """A drag: the points when the button went down, and which of them move."""

    points: Points
    chosen: tuple[int, ...]
    start: tuple[float, float]
    number: int
    vertical: bool = False
    added: bool = False
    box: QPointF | None = None
    handle: Handle | None = None
    moved: bool = False


class ViewTool(Tool):
    """Shows time and value under the pointer; a drag pans."""

    #: The visible part moves by so many seconds.
    pan_requested = Signal(float)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._from: QPointF | None = None
        self._at: QPointF | None = None

    def press(self, content: EditorContent, at: QPointF, button: Button, held: Modifier) -> None:
        self._from = at

    def move(self, content: EditorContent, at: QPointF, held: Modifier) -> None:
        self._at = at
        if self._from is not None:
            self.pan_requested.emit((self._from.x() - at.x()) / content.scale.px_per_s)
            self._from = at

    def release(self, content: EditorContent) -> None:
        self._from = None

    def cancel(self) -> bool:
        had, self._from = self._from is not None, None
        return had

    def paint(self, painter: QtGui.QPainter, content: EditorContent, theme: Theme) -> None:
        """Paint a crosshair with its reading."""
        played = content.played
        if self._at is None or played is None or not content.area.contains(self._at):
            return
        index = round(content.scale.time(self._at.x()) * content.sample_rate_hz)
        if not 0 <= index < played.size:
            return
        time_s, value = index / content.sample_rate_hz, float(played[index])
        here = content.at(time_s, value)
        painter.setPen(QtGui.QPen(QtGui.QColor(theme.dim), 1, Qt.PenStyle.DotLine))
        area = content.area
        painter.drawLine(QPointF(here.x(), area.top()), QPointF(here.x(), area.bottom()))
        text = f"{value_text(time_s, 's', digits=5)}   {number_text(value, 4)}"
        metrics = QtGui.QFontMetricsF(painter.font())
        width = metrics.horizontalAdvance(text) + 10
        left = min(here.x() + 6, area.right() - width)
        room = QRectF(left, area.top() + 2, width, metrics.height() + 2)
        paint_card(painter, room, text, theme)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QtGui.QColor(theme.accent))
        painter.drawEllipse(here, 3, 3)


class Pen(Tool):
    """Draws freehand; with Shift a straight line; with the right button back to zero.

    One stroke is one step of the history: all its edits share a number.

    Attributes
    ----------
    may_begin
        Returns whether the clip may be drawn on.
    """

    #: Samples in place of those before, and the number of the stroke.
    drawn = Signal(object, int)
    #: The stroke is given up: samples as they were, and its number.
    cancelled = Signal(int)
    #: Why nothing can be drawn.
    refused = Signal(str)

    cursor = Qt.CursorShape.CrossCursor

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.may_begin: Callable[[], bool] = lambda: True
        self._before: Floats | None = None
        self._stroke = Stroke()
        self._first: tuple[float, float] | None = None
        self._last_s = 0.0
        self._zeroes = False
        self._number = 0
        self._changed = False

    def press(self, content: EditorContent, at: QPointF, button: Button, held: Modifier) -> None:
        if self._first is not None or button not in (Button.LeftButton, Button.RightButton):
            return
        if not self.may_begin() or content.drawn is None:
            return
        self._zeroes = button == Button.RightButton
        self._before, self._number, self._changed = content.drawn, new_gesture(), False
        self._first = self._place(content, at)
        self._last_s, self._stroke = self._first[0], Stroke()
        self.move(content, at, held)

    def move(self, content: EditorContent, at: QPointF, held: Modifier) -> None:
        if self._first is None or self._before is None:
            return
        time_s, value = self._place(content, at)
        rate_hz = content.sample_rate_hz
        try:
            if self._zeroes:
                samples = zeroed(self._before, self._first[0], time_s, rate_hz)
            else:
                if held & Modifier.ShiftModifier:
                    self._stroke = Stroke.through((self._first, (time_s, value)))
                else:
                    self._stroke = self._stroke.to(time_s, value, self._last_s)
                samples = drawn_over(self._before, self._stroke, rate_hz)
        except InvalidInputError as error:
            self.refused.emit(str(error))
            return
        self._last_s, self._changed = time_s, True
        self.drawn.emit(samples, self._number)

    def release(self, content: EditorContent) -> None:
        self._first = None

    def cancel(self) -> bool:
        if self._first is None:
            return False
        self._first = None
        if self._changed:
            self.cancelled.emit(self._number)
        return True

    def paint(self, painter: QtGui.QPainter, content: EditorContent, theme: Theme) -> None:
        """Mark the points of the stroke."""
        if self._first is None or self._zeroes:
            return
        painter.setPen(QtGui.QPen(QtGui.QColor(theme.accent), 3))
        for time_s, value in self._stroke.points:
            painter.drawPoint(content.at(time_s, value))

    def _place(self, content: EditorContent, at: QPointF) -> tuple[float, float]:
        time_s, value = content.place(at)
        # Up to 1, or up to the largest visible value of a louder clip.
        full = content.high if content.high > REACH else 1.0
        return max(time_s, 0.0), min(max(value, -full), full)


#: Distance within which the pointer catches a point, or the curve, px.
ENVELOPE_CATCH_PX = 9.0
_FINE = 0.1
_HOW = "Click the line, or double-click beside it: a new point. Drag points to shape it"

_ENVELOPE = CurveStyle(how=_HOW)


class EnvelopeTool(Tool):
    """Edits the points of a curve.

    A click on the curve adds a point; with Alt it changes the kind of the segment. A drag moves
    points, or a segment up and down, or draws a box that chooses points; the handles around several
    chosen points scale them. Ctrl: finely. Shift: only up and down, or only along the time.

    Parameters
    ----------
    points
        Returns the points as they are now.
    style
        How the curve is painted, and what its values are.
    """

    #: The points, and the number of the gesture or None.
    changed = Signal(object, object)
    #: The drag of this number is given up: all is as it was before.
    cancelled = Signal(int)

    def __init__(
        self, points: Callable[[], Points], parent: QObject, style: CurveStyle = _ENVELOPE
    ) -> None:
        super().__init__(parent)
        self._points, self._style = points, style
        self.chosen: tuple[int, ...] = ()
        self._drag: Drag | None = None
        self._pointer = QPointF(-1, -1)

    @property
    def hint(self) -> str:
        return self._style.how if len(self._points()) == 1 and not self.chosen else ""

    def press(self, content: EditorContent, at: QPointF, button: Button, held: Modifier) -> None:
        if button != Button.LeftButton or self._drag is not None:
            return
        points = self._points()
        index = _point_at(content, points, at)
        start, number = content.place(at), new_gesture()
        if index is not None:
            if held & Modifier.ShiftModifier:
                self.chosen = tuple(sorted(set(self.chosen) ^ {index}))
            elif index not in self.chosen:
                self.chosen = (index,)
            self._drag = Drag(points, self.chosen or (index,), start, number)
            return
        handle = handle_at(content, points, self.chosen, at)
        if handle is not None:
            self._drag = Drag(points, self.chosen, start, number, handle=handle)
            return
        segment = _segment_at(content, points, at)
        if segment is None:
            self._drag = Drag(points, (), start, number, box=at)
        elif held & Modifier.AltModifier and self._style.bends:
            here = SEGMENTS.index(points[segment][2])
            self._bend(segment, SEGMENTS[(here + 1) % len(SEGMENTS)])
        else:
            # A click adds a point on the curve; a drag moves the segment up and down, or, where the
            # curve is level before the first or after the last point, the new point alone.
            if 0 <= segment < len(points) - 1:
                self._drag = Drag(points, (segment, segment + 1), start, number, vertical=True)
            else:
                added = algebra.with_point(points, max(start[0], 0.0))
                index = 0 if segment < 0 else len(added) - 1
                self._drag = Drag(added, (index,), start, number, added=True)

    def move(self, content: EditorContent, at: QPointF, held: Modifier) -> None:
        self._pointer = at
        drag = self._drag
        if drag is None:
            return
        time_s, value = content.place(at)
        by_s, by_value = time_s - drag.start[0], value - drag.start[1]
        away = content.at(*drag.start) - at
        drag.moved = drag.moved or max(abs(away.x()), abs(away.y())) >= 3
        if not drag.moved:
            return
        if drag.box is not None:
            covered = QRectF(drag.box, at).normalized()
            self.chosen = tuple(
                k for k, point in enumerate(drag.points) if covered.contains(content.at(*point[:2]))
            )
            return
        if held & Modifier.ControlModifier:
            by_s, by_value = by_s * _FINE, by_value * _FINE
        if drag.vertical or (held & Modifier.ShiftModifier and abs(away.y()) > abs(away.x())):
            by_s = 0.0
        elif held & Modifier.ShiftModifier:
            by_value = 0.0
        if drag.handle is not None:
            scaled = scaled_by(drag.points, drag.chosen, drag.handle, by_s, by_value)
            self.changed.emit(scaled, drag.number)
            return
        lowest, fine = min(drag.points[k][1] for k in drag.chosen), held & Modifier.ControlModifier
        if by_value and not fine and abs(lowest + by_value) * content.px_per_value < 1.0:
            # No pixel may be that of 0.
            by_value = -lowest
        self.changed.emit(algebra.moved(drag.points, drag.chosen, by_s, by_value), drag.number)

    def release(self, content: EditorContent) -> None:
        drag, self._drag = self._drag, None
        if drag is None or drag.moved:
            return
        if drag.added:
            self.chosen = drag.chosen
            self.changed.emit(drag.points, None)
        elif drag.vertical:
            points = algebra.with_point(drag.points, drag.start[0])
            self.chosen = (algebra.index_for(drag.points, drag.start[0]),)
            self.changed.emit(points, None)
        elif drag.box is not None:
            self.chosen = ()

    def double_click(self, content: EditorContent, at: QPointF) -> None:
        """Put a point there, wherever the curve is."""
        if _point_at(content, self._points(), at) is None:
            self._put(content.place(at))

    def fill_menu(self, menu: QtWidgets.QMenu, content: EditorContent, at: QPointF | None) -> None:
        points = self._points()
        if at is not None:
            index = _point_at(content, points, at)
        else:
            index = next((number for number in self.chosen if number < len(points)), None)
        if index is not None:
            if index not in self.chosen:
                self.chosen = (index,)
            bend = partial(self._bend, index) if self._style.bends else None
            n = len(self.chosen)
            fill_point_menu(menu, self.remove_chosen, bend=bend, n_chosen=n, n_points=len(points))
        elif at is not None and content.area.contains(at):
            fill_ground_menu(menu, partial(self._put, content.place(at)))

    def cancel(self) -> bool:
        drag, self._drag = self._drag, None
        if drag is not None and drag.moved and drag.box is None:
            self.cancelled.emit(drag.number)
        return drag is not None

    def nudge(self, by_s: float, by_value: float, gesture: int) -> None:
        """Move the selected points."""
        if self.chosen:
            moved = algebra.moved(self._points(), self.chosen, by_s, by_value)
            self.changed.emit(moved, gesture)

    def choose_next(self, step: int) -> None:
        """Choose the point after the chosen one, or before; the first or last of all at first."""
        last = len(self._points()) - 1
        number = (0 if step > 0 else last) if not self.chosen else self.chosen[-1] + step
        self.chosen = (min(max(number, 0), last),)

    def is_near(self, content: EditorContent, at: QPointF) -> bool:
        """Return whether a point, or the curve, is within reach."""
        points = self._points()
        near = _point_at(content, points, at) is not None
        return near or _segment_at(content, points, at) is not None

    def remove_chosen(self) -> None:
        """Remove the selected points."""
        if self.chosen:
            left, number = algebra.without_chosen(self._points(), self.chosen)
            self.chosen = (number,)
            self.changed.emit(left, None)

    def paint(self, painter: QtGui.QPainter, content: EditorContent, theme: Theme) -> None:
        """Paint curve, points and box."""
        points = self._points()
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        colour = QtGui.QColor(getattr(theme, self._style.colour))
        shown = np.linspace(content.area.left(), content.area.right(), 400)
        times = content.scale.shown_s[0] + (shown - content.scale.left_px) / content.scale.px_per_s
        values = algebra.curve_at(points, times)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        x, y = content.curve(times, values)
        curve = arrayToQPath(x, y, finiteCheck=False)
        painter.setPen(QtGui.QPen(colour, 1))
        # Qt paints four thin lines in a sixth of the time of one line of 2 px.
        for right, down in product((-0.5, 0.5), repeat=2):
            painter.drawPath(curve.translated(right, down))
        if self._style is _ENVELOPE:
            _paint_fades(painter, content, colour)
        if self._style.mirrored:
            painter.setPen(QtGui.QPen(colour, 1, Qt.PenStyle.DotLine))
            painter.drawPath(arrayToQPath(x, content.curve(times, -values)[1], finiteCheck=False))
        near = _point_at(content, points, self._pointer)
        places = _envelope_places(content, points)
        paint_points(painter, places, self.chosen, near, self._style, theme)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        if self._drag is not None and self._drag.box is not None:
            painter.setPen(QtGui.QPen(QtGui.QColor(theme.accent), 1))
            painter.drawRect(QRectF(self._drag.box, self._pointer).normalized())
        else:
            paint_box(painter, content, points, self.chosen, theme)
        if len(self.chosen) == 1 and self.chosen[0] < len(points):
            write_point(painter, content, points[self.chosen[0]], self._style, theme)

    def _put(self, place: tuple[float, float]) -> None:
        added, index = algebra.with_point_put(self._points(), *place, self._style.highest)
        self.chosen = (index,)
        self.changed.emit(added, None)

    def _bend(self, index: int, segment: Segment) -> None:
        self.changed.emit(algebra.with_segment(self._points(), index, segment), None)


def _paint_fades(painter: QtGui.QPainter, content: EditorContent, colour: QtGui.QColor) -> None:
    """Paint what fades the ends, dashed as in the timeline, where it is changed."""
    ends = faded_ends(content.clip)
    painter.setPen(QtGui.QPen(colour, 1.5, Qt.PenStyle.DashLine))
    for start_s, way, end in zip((0.0, content.clip.duration_s), (1, -1), ends, strict=True):
        if end is not None:
            inside_s, levels = end.course(fades_out=way < 0)
            x, y = content.curve(start_s + way * inside_s, levels)
            painter.drawPath(arrayToQPath(x, y, finiteCheck=False))


def _envelope_places(content: EditorContent, points: Points) -> tuple[Floats, Floats]:
    """Return the places of points, (n,) each, px."""
    times_s, values = np.array([point[:2] for point in points]).reshape(-1, 2).T
    return content.curve(times_s, values)


def _point_at(content: EditorContent, points: Points, at: QPointF) -> int | None:
    if not points:
        return None
    x, y = _envelope_places(content, points)
    away = np.maximum(np.abs(x - at.x()), np.abs(y - at.y()))
    nearest = int(away.argmin())
    return None if away[nearest] > ENVELOPE_CATCH_PX else nearest


def _segment_at(content: EditorContent, points: Points, at: QPointF) -> int | None:
    """Return the point after which the curve passes here; -1 before the first."""
    time_s, _ = content.place(at)
    value = float(algebra.curve_at(points, np.array([time_s]))[0])
    if abs(content.y(value) - at.y()) > ENVELOPE_CATCH_PX:
        return None
    return sum(point[0] <= time_s for point in points) - 1


_GLIDE_HOW = "Drag the points of frequency and amplitude; click a line to add one"
STYLES: dict[Column, CurveStyle] = {
    "frequency": CurveStyle(
        colour="error", mirrored=False, unit="Hz", label="Frequency", bends=False, how=_GLIDE_HOW
    ),
    "amplitude": CurveStyle(label="Amplitude", highest=1.0, bends=False, how=_GLIDE_HOW),
}
_ROW_PX = 34.0


class GlideTool(Tool):
    """Edits both curves of a glide; keys go to the one that was touched last.

    Parameters
    ----------
    points
        Returns the points of a curve as they are now.

    Attributes
    ----------
    active
        The curve that was touched last.
    tools
        The tool of each curve.
    """

    #: Which curve, its points, and the number of the gesture or None.
    changed = Signal(str, object, object)
    #: The drag of this number is given up: all is as it was before.
    cancelled = Signal(int)

    def __init__(self, points: Callable[[Column], Points], parent: QObject) -> None:
        super().__init__(parent)
        self.active: Column = "frequency"
        self.tools: dict[Column, EnvelopeTool] = {}
        for column, style in STYLES.items():
            tool = EnvelopeTool(partial(points, column), self, style)
            tool.changed.connect(partial(self.changed.emit, column))
            tool.cancelled.connect(self.cancelled)
            self.tools[column] = tool

    @property
    def other(self) -> Column:
        """The curve that was not."""
        return "amplitude" if self.active == "frequency" else "frequency"

    @property
    def hint(self) -> str:
        return self.tools[self.active].hint

    def flip(self) -> None:
        """Give the keys to the other curve."""
        self.cancel()
        self.active = self.other

    def press(self, content: EditorContent, at: QPointF, button: Button, held: Modifier) -> None:
        self._touch(content, at)
        self.tools[self.active].press(of_column(content, self.active), at, button, held)

    def move(self, content: EditorContent, at: QPointF, held: Modifier) -> None:
        for column, tool in self.tools.items():
            tool.move(of_column(content, column), at, held)

    def release(self, content: EditorContent) -> None:
        self.tools[self.active].release(of_column(content, self.active))

    def double_click(self, content: EditorContent, at: QPointF) -> None:
        self._touch(content, at)
        self.tools[self.active].double_click(of_column(content, self.active), at)

    def fill_menu(self, menu: QtWidgets.QMenu, content: EditorContent, at: QPointF | None) -> None:
        if at is not None:
            self._touch(content, at)
        self.tools[self.active].fill_menu(menu, of_column(content, self.active), at)

    def cancel(self) -> bool:
        return any(tool.cancel() for tool in self.tools.values())

    def forget(self) -> None:
        """Choose no point."""
        for tool in self.tools.values():
            tool.chosen = ()

    def paint(self, painter: QtGui.QPainter, content: EditorContent, theme: Theme) -> None:
        """Paint both curves, the one that has the keys last, and what frequencies lie where."""
        own = of_column(content, "frequency")
        self._paint_scale(painter, own, theme)
        for column in (self.other, self.active):
            painter.setOpacity(1.0 if column == self.active else 0.6)
            self.tools[column].paint(painter, of_column(content, column), theme)
        painter.setOpacity(1.0)

    def _touch(self, content: EditorContent, at: QPointF) -> None:
        """Choose the curve that passes here, if one does; of two, the one that was touched last."""
        for column in (self.active, self.other):
            if self.tools[column].is_near(of_column(content, column), at):
                if column != self.active:
                    self.tools[self.active].chosen = ()
                self.active = column
                return

    def _paint_scale(self, painter: QtGui.QPainter, content: EditorContent, theme: Theme) -> None:
        area, metrics = content.area, QtGui.QFontMetricsF(painter.font())
        painter.setPen(QtGui.QColor(theme.error))
        top_hz = content.sample_rate_hz / 2.0
        for tick in linear_ticks(0.0, top_hz, max(area.height() / _ROW_PX, 2)):
            y = content.y(tick.value)
            text = f"{tick.label} Hz"
            width, height = metrics.horizontalAdvance(text), metrics.height()
            room = QRectF(area.right() - width - 4, y - height / 2, width, height)
            if room.top() >= area.top() and room.bottom() <= area.bottom():
                painter.drawText(room, Qt.AlignmentFlag.AlignCenter, text)


def of_column(content: EditorContent, column: Column) -> EditorContent:
    """Return the content whose vertical axis is that of a curve: 0 to half the sample rate, Hz."""
    if column == "amplitude":
        return content
    return replace(content, low=0.0, high=content.sample_rate_hz / 2.0)
