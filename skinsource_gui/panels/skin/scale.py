"""The colour bar of the skin map: a scale whose ends are dragged or typed, or follow the design."""

from collections.abc import Callable
from functools import lru_cache
from math import inf

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal

from skinsource.base.conventions import Floats
from skinsource.specs.numbers import NumberSpec
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.panels.skin.content import MapContent
from skinsource_gui.panels.skin.painting import small_font
from skinsource_gui.panels.skin.settings import (
    HIGHEST_DB,
    LOWEST_DB,
    SMALLEST_SPAN_DB,
    LevelRange,
    moved,
    pushed_high,
    pushed_low,
    with_high,
    with_low,
)
from skinsource_gui.plots.small_map import ColourScale, paint_ramp
from skinsource_gui.qt.frames import CachedPicture
from skinsource_gui.qt.keys import meaning_of
from skinsource_gui.qt.layouts import in_row, named, tooltip
from skinsource_gui.qt.resources import number_named
from skinsource_gui.qt.theme import UNIT_PX, current_theme, tabular

#: Returns a range of which an end, or both, was moved.
Change = Callable[[LevelRange, float], LevelRange]
_KEY_STEPS_DB = {
    Qt.Key.Key_Up: 1.0,
    Qt.Key.Key_Right: 1.0,
    Qt.Key.Key_Down: -1.0,
    Qt.Key.Key_Left: -1.0,
    Qt.Key.Key_PageUp: 10.0,
    Qt.Key.Key_PageDown: -10.0,
}


def key_step_db(event: QtGui.QKeyEvent) -> float:
    """Return the step of a key, dB; 0 for none."""
    if not meaning_of("colour_bar", event):
        return 0.0
    step = _KEY_STEPS_DB[Qt.Key(event.key())]
    if event.modifiers() & Qt.KeyboardModifier.ControlModifier:
        return step / 10
    if event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
        return step * 5
    return step


def marks_of_levels(levels: Floats, outputs: tuple[int, ...]) -> tuple[tuple[float, int], ...]:
    """Return the levels of the selected outputs, each with its rank, for the colour bar."""
    return tuple(
        (float(levels[number - 1]), rank)
        for rank, number in enumerate(outputs)
        if number <= levels.size
    )


def _low_moved(range_db: LevelRange, by_db: float) -> LevelRange:
    return with_low(range_db, range_db[0] + by_db)


def _high_moved(range_db: LevelRange, by_db: float) -> LevelRange:
    return with_high(range_db, range_db[1] + by_db)


_MARK_PX, _RAMP_PX, _GRIP_PX = 7, 10, 14


@lru_cache(maxsize=2)
def _beyond_px(font: QtGui.QFont) -> float:
    """Return how far the numbers at both ends reach beyond the colours, px."""
    return QtGui.QFontMetricsF(small_font(font)).horizontalAdvance("≤ −100") / 2.0


class ColourStrip(QtWidgets.QWidget):
    """The colours with numbers below and the selected outputs above.

    A drag at an end moves that, a drag between them both; the limits of signed values stay alike.
    """

    #: A range, or None for the automatic one.
    range_chosen = Signal(object)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._scale = ColourScale(range_db=MapContent().value_range, text_below="")
        # The range at the press, where that was on the screen, and what it moves.
        self._held: tuple[LevelRange, float, Change] | None = None
        self._marks: tuple[tuple[float, int], ...] = ()
        self._picture = CachedPicture()
        title, hint = "Range of the colours", "Drag an end, or between; double-click: automatic"
        named(self, "colour_strip", title, tooltip(title, hint))
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        # It paints all of its area, so that nothing behind it has to be painted.
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setCursor(Qt.CursorShape.SizeHorCursor)

    @property
    def value_range(self) -> LevelRange:
        """Values of the lowest and the highest colour."""
        return self._scale.range_db

    def sizeHint(self) -> QSize:
        line = QtGui.QFontMetrics(small_font(self.font())).height()
        return QSize(160, _MARK_PX + _RAMP_PX + line)

    def minimumSizeHint(self) -> QSize:
        return QSize(60, self.sizeHint().height())

    def show_scale(self, scale: ColourScale, marks: tuple[tuple[float, int], ...]) -> None:
        """Show colours and their range, and levels of selected outputs, each in its colour."""
        before = self._scale, self._placed_marks()
        self._scale, self._marks = scale, marks
        if (scale, self._placed_marks()) != before:
            self.update()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        theme = current_theme()
        painter = QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        painter.setFont(tabular(small_font(self.font())))
        ramp, scale = self._ramp(), self._scale
        self._picture.paint(
            painter,
            QRectF(self.rect()),
            (scale, theme.name),
            lambda on_image: paint_ramp(on_image, ramp, scale, theme),
            self.palette().window().color(),
        )
        painter.setPen(QtGui.QPen(QtGui.QColor(theme.base), 0.5))
        for x, rank in self._placed_marks():
            painter.setBrush(theme.output_colour(rank))
            tip, back = ramp.top() - 1, ramp.top() - _MARK_PX
            painter.drawPolygon([QPointF(x, tip), QPointF(x - 4, back), QPointF(x + 4, back)])
        edge = theme.accent if self.hasFocus() else theme.dim
        painter.setPen(QtGui.QPen(QtGui.QColor(edge), 1.5))
        painter.setBrush(QtGui.QColor(theme.raised))
        for x in (ramp.left(), ramp.right()):
            painter.drawRoundedRect(QRectF(x - 3, ramp.top() - 2, 6, _RAMP_PX + 4), 2, 2)

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            x, ramp = event.position().x(), self._ramp()
            near_low, near_high = x < ramp.left() + _GRIP_PX, x > ramp.right() - _GRIP_PX
            change = _low_moved if near_low else _high_moved if near_high else moved
            self._held = self.value_range, x, change

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        if self._held is None:
            return
        held, pressed_x, change = self._held
        part = (event.position().x() - pressed_x) / self._ramp().width()
        by = part * (held[1] - held[0])
        if self._scale.signed:
            end = held[1] + (-by if change is _low_moved else by)
            self.range_chosen.emit(_alike(max(end, 0.01 * held[1])))
        elif round(by, 1) or self.value_range != held:
            low, high = change(held, round(by, 1))
            self.range_chosen.emit((round(low, 1), round(high, 1)))

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        self._held = None

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:
        self.range_chosen.emit(None)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        step_db = key_step_db(event)
        if not step_db:
            super().keyPressEvent(event)
        elif self._scale.signed:
            self.range_chosen.emit(_alike(self.value_range[1] * 10.0 ** (step_db / 20.0)))
        else:
            self.range_chosen.emit(moved(self.value_range, step_db))

    def _placed_marks(self) -> list[tuple[float, int]]:
        """Return x of each mark, in half px: less is not seen, and painted anew for each step."""
        (low, high), ramp = self.value_range, self._ramp()
        parts = (min(max((level - low) / (high - low), 0.0), 1.0) for level, _ in self._marks)
        places = (round(2 * (ramp.left() + part * ramp.width())) / 2 for part in parts)
        return list(zip(places, (rank for _, rank in self._marks), strict=True))

    def _ramp(self) -> QRectF:
        beyond = _beyond_px(self.font())
        return QRectF(beyond, _MARK_PX, max(self.width() - 2.0 * beyond, 1.0), _RAMP_PX)


def _alike(limit: float) -> LevelRange:
    """Return limits of signed values, with three digits."""
    limit = float(f"{limit:.3g}")
    return -limit, limit


def _end_field(name: str, spec: NumberSpec, parent: QtWidgets.QWidget) -> NumberField:
    field = NumberField(spec, parent, widest_unit=spec.unit)
    named(field, name, spec.label, tooltip(spec.label, spec.hint))
    return field


_LOW = number_named("lowest_colour", minimum=LOWEST_DB, maximum=HIGHEST_DB - SMALLEST_SPAN_DB)
_HIGH = number_named("highest_colour", minimum=LOWEST_DB + SMALLEST_SPAN_DB, maximum=HIGHEST_DB)
_LIMIT = number_named("limit_of_colours")


class ColourBar(QtWidgets.QWidget):
    """The colours of the map with a field for either end; of signed values one field for both."""

    #: A range, or None for the automatic one.
    range_chosen = Signal(object)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.low_field = _end_field("range_low_field", _LOW, self)
        self.strip = ColourStrip(self)
        self.high_field = _end_field("range_high_field", _HIGH, self)
        self.limit_field = _end_field("z_limit", _LIMIT, self)
        in_row(
            self.low_field,
            (self.strip, 1),
            self.high_field,
            self.limit_field,
            of=self,
            margins=0,
            gap_px=UNIT_PX // 2,
        )
        self.strip.range_chosen.connect(self.range_chosen)
        choose = self.range_chosen.emit
        self.low_field.edited.connect(
            lambda low, _: choose(pushed_low(self.strip.value_range, low))
        )
        self.high_field.edited.connect(
            lambda high, _: choose(pushed_high(self.strip.value_range, high))
        )
        self.limit_field.edited.connect(lambda limit, _: choose((-limit, limit)))
        self._fit()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._fit()

    def _fit(self) -> None:
        for field in (self.low_field, self.high_field, self.limit_field):
            text = "−99.9 dB" if field is not self.limit_field else "0.0005 m/s²"
            field.setFixedWidth(self.fontMetrics().horizontalAdvance(text) + 2 * UNIT_PX)

    def show_content(self, content: MapContent) -> None:
        """Show the colours of a map and their range, and the values of the selected outputs."""
        low, high = content.value_range
        signed, values = content.quantity.signed, content.coloured_values
        self.low_field.setVisible(not signed)
        self.high_field.setVisible(not signed)
        self.limit_field.setVisible(signed)
        if signed:
            self.limit_field.set_value(high)
        else:
            self.low_field.set_value(round(low, 1))
            self.high_field.set_value(round(high, 1))
        self.strip.show_scale(
            scale_of(content), () if values is None else marks_of_levels(values, content.outputs)
        )


def scale_of(content: MapContent) -> ColourScale:
    """Return the scale of the colours of a map."""
    signed, (low, high) = content.quantity.signed, content.value_range
    return ColourScale(
        range_db=(low, high),
        text_below=content.quantity.unit,
        colours=content.colours,
        signed=signed,
        # By how much is not said: the strip is painted once for all steps of the knob.
        reached_db=(-inf if signed else low, inf) if content.exceeded else None,
    )
