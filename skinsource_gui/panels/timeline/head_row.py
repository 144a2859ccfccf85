"""The head of one track: its place, and what is changed most often."""

from dataclasses import dataclass

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QObject, QRect, QRectF, Qt, Signal

from skinsource.design.clips import Clip
from skinsource.design.design import AMPLITUDE, Input
from skinsource.limbs.locations import input_name
from skinsource.specs.numbers import NumberSpec
from skinsource_gui.fields.inputs import EMPTY, clip_text, clips_text, duration_text
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.qt.buttons import (
    SWATCH_PX,
    LetterButton,
    mute_button,
    paint_swatch,
    remove_button,
    solo_button,
)
from skinsource_gui.qt.theme import UNIT_PX, Theme, current_theme, scaled
from skinsource_gui.qt.tooltips import show_tooltip

#: Height of a row.
ROW_PX = 48
#: Width of a head; height of a line of text at which sizes are as written here, px.
HEADS_PX, USUAL_LINE_PX = 196, 14
# Heads of larger text leave the lanes room too.
_MOST_HEADS_PX = 320
_LINE_PX, _FIRST_LINE_PX = 20, 3
_AMPLITUDE_PX, _GAIN_PX = 90, 54
_BETWEEN_PX = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class RowPlaces:
    """Places of the parts of a head, px.

    Attributes
    ----------
    swatch, name
        Number of the place and its name, which are painted.
    peak
        The peak that results from a gain, painted beside it.
    """

    row: QRect
    swatch: QRectF
    name: QRect
    amplitude: QRect
    mute: QRect
    solo: QRect
    remove: QRect
    peak: QRect


def heads_px(line_px: int) -> int:
    """Return the width of heads for lines of text of this height, px."""
    return min(round(HEADS_PX * max(line_px / USUAL_LINE_PX, 1.0)), _MOST_HEADS_PX)


def row_places(width: int, line_px: int = USUAL_LINE_PX, *, peak: bool = False) -> RowPlaces:
    """Return the places of the parts of a head, in two lines.

    Parameters
    ----------
    width
        Width of the head, px.
    line_px
        Height of a line of text; where it is larger than usual, so is the head.
    peak
        Whether there is a peak beside the amplitude.
    """
    scale = max(line_px / USUAL_LINE_PX, 1.0)

    def px(usual: int) -> int:
        return round(scale * usual)

    height, line, swatch = px(ROW_PX), px(_LINE_PX), px(SWATCH_PX)
    text_left = UNIT_PX + swatch + UNIT_PX
    first = px(_FIRST_LINE_PX)
    second = first + line + 2
    step, right = line + _BETWEEN_PX, width - UNIT_PX // 2
    solo, mute = (QRect(right - step * count, first, line, line) for count in (1, 2))
    remove = QRect(right - step, second, line, line)
    amplitude_px = px(_GAIN_PX if peak else _AMPLITUDE_PX)
    amplitude_px = min(amplitude_px, remove.x() - text_left - UNIT_PX // 2)
    peak_left = text_left + amplitude_px + UNIT_PX // 2
    return RowPlaces(
        row=QRect(0, 0, width, height),
        swatch=QRectF(UNIT_PX, (height - swatch) / 2, swatch, swatch),
        name=QRect(text_left, first, mute.x() - text_left - _BETWEEN_PX, line),
        amplitude=QRect(text_left, second, amplitude_px, line + 1),
        mute=mute,
        solo=solo,
        remove=remove,
        peak=QRect(peak_left, second, remove.x() - peak_left, line + 1),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class RowState:
    """State of one head.

    Attributes
    ----------
    silent
        Whether the track is muted, or another one is solo.
    last
        Whether the track was selected last.
    amplitude
        What an amplitude is, and its unit.
    peak
        The peak that results where the amplitude is a plain factor, else "".
    clip
        The selected clip, or else the first.
    limb
        Limb of the places.
    """

    track: Input
    silent: bool
    selected: bool
    last: bool
    amplitude: NumberSpec
    clip: Clip | None
    limb: str = ""
    peak: str = ""

    @property
    def figure(self) -> str:
        """What the track plays, and for how long."""
        if self.clip is None:
            return EMPTY
        others = clips_text(len(self.track.clips))
        lasts = duration_text(self.clip.duration_s)
        return f"{clip_text(self.clip)} · {lasts}{others}"

    @property
    def title(self) -> str:
        """What the track plays."""
        return EMPTY if self.clip is None else clip_text(self.clip)

    @property
    def painted(self) -> tuple[object, ...]:
        """What the painted parts depend on."""
        marks = self.selected, self.last, self.silent, self.peak
        return self.track.location, self.track.colour, self.limb, *marks


_MARK_PX = 3
_TINT_ALPHA = 28
_SMALLER = 0.8


def paint_row(
    painter: QtGui.QPainter, state: RowState, places: RowPlaces, theme: Theme, *, focused: bool
) -> None:
    """Paint ground, place and name of a track, and the peak that results from a gain."""
    _paint_ground(painter, state, places.row, theme, focused=focused)
    track, silent = state.track, state.silent
    paint_swatch(
        painter,
        places.swatch,
        track.location,
        theme.input_colour(track.colour),
        QtGui.QColor(theme.text),
        silent=silent,
    )
    usual = painter.font()
    painter.setPen(QtGui.QColor(theme.dim if silent else theme.text))
    font = QtGui.QFont(usual)
    font.setWeight(QtGui.QFont.Weight.Medium)
    painter.setFont(font)
    place = input_name(track.location, state.limb)
    fits = painter.fontMetrics().horizontalAdvance(place.name) <= places.name.width()
    short_name = place.short_name[0].upper() + place.short_name[1:]
    _write(painter, places.name, place.name if fits else short_name)
    painter.setFont(usual)
    if state.peak:
        painter.setPen(QtGui.QColor(theme.dim))
        painter.setFont(scaled(usual, _SMALLER))
        room, text = places.peak.width(), f"peak {state.peak}"
        fits = painter.fontMetrics().horizontalAdvance(text) <= room
        _write(painter, places.peak, text if fits else state.peak)
        painter.setFont(usual)


def _paint_ground(
    painter: QtGui.QPainter, state: RowState, row: QRect, theme: Theme, *, focused: bool
) -> None:
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.border), 1))
    painter.drawLine(UNIT_PX, row.bottom(), row.width() - UNIT_PX, row.bottom())
    if not state.selected:
        return
    tint = QtGui.QColor(theme.accent)
    if state.last:
        painter.fillRect(0, 0, _MARK_PX, row.height(), tint)
    if state.last and focused:
        painter.setPen(QtGui.QPen(tint, 2))
        painter.drawRect(QRectF(row).adjusted(1, 1, -1, -1))
    tint.setAlpha(_TINT_ALPHA)
    painter.fillRect(row, tint)


def _write(painter: QtGui.QPainter, place: QRect, text: str) -> None:
    track = painter.fontMetrics().elidedText(text, Qt.TextElideMode.ElideRight, place.width())
    painter.drawText(place, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, track)


class InputRow(QtWidgets.QWidget):
    """The head of a track: what is painted, and the controls; keys go to the list around it."""

    #: The keyboard went to its number.
    entered = Signal()

    def __init__(self, rows: QtWidgets.QWidget) -> None:
        super().__init__(rows)
        self._rows = rows
        self._state: RowState | None = None
        self.setObjectName("input_row")
        self.amplitude = NumberField(AMPLITUDE, self, widest_unit="")
        self.amplitude.setObjectName("amplitude_field")
        # The theme's fields are as high as a line of a form, too high for two lines in a row.
        self.amplitude.setStyleSheet("QLineEdit { min-height: 0; padding: 0 4px; }")
        self.mute, self.solo, self.remove = (
            mute_button(self),
            solo_button(self),
            remove_button(self),
        )
        self.amplitude.installEventFilter(self)
        self._lay_out()

    @property
    def controls(self) -> tuple[NumberField | LetterButton, ...]:
        """Controls that the keyboard reaches, in its order."""
        return (self.amplitude, self.mute, self.solo, self.remove)

    @property
    def id(self) -> int:
        """Id of the track."""
        return self.state.track.id

    @property
    def state(self) -> RowState:
        """What is shown; only a head that shows a track has a state."""
        if self._state is None:
            raise LookupError("this row shows no input yet")
        return self._state

    def show_state(self, state: RowState) -> None:
        """Show an input."""
        if state == self._state:
            return
        old, self._state = self._state, state
        track = state.track
        self.amplitude.set_spec(state.amplitude)
        self.amplitude.set_value(track.amplitude)
        self.mute.setChecked(track.muted)
        self.solo.setChecked(track.solo)
        if old is None or old.last != state.last:
            self._set_focus_policies(state.last)
        place = input_name(track.location, state.limb)
        self.setAccessibleName(
            f"Input at {place.number}, {place.name}: {state.title}"
            f"{', silent' if state.silent else ''}"
        )
        peak = f"\nPeak {state.peak}" if state.peak else ""
        show_tooltip(self, f"{place.number} · {place.name}\n{state.figure}{peak}")
        if bool(state.peak) != bool(old and old.peak):
            self._lay_out()
        # The controls paint themselves.
        if old is None or old.painted != state.painted:
            self.update()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if watched is self.amplitude and event.type() == QEvent.Type.FocusIn:
            self.entered.emit()
        return super().eventFilter(watched, event)

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._lay_out()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._lay_out()

    def _lay_out(self) -> None:
        peak = self._state is not None and bool(self._state.peak)
        places = self._places = row_places(self.width(), self.fontMetrics().height(), peak=peak)
        self.setFixedHeight(places.row.height())
        self.amplitude.setGeometry(places.amplitude)
        self.mute.setGeometry(places.mute)
        self.solo.setGeometry(places.solo)
        self.remove.setGeometry(places.remove)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        if self._state is not None:
            painter = QtGui.QPainter(self)
            focused = self._rows.hasFocus()
            paint_row(painter, self._state, self._places, current_theme(), focused=focused)

    def _set_focus_policies(self, selected: bool) -> None:
        # One row at a time: twenty rows of four stops each would be a long way.
        number = Qt.FocusPolicy.StrongFocus if selected else Qt.FocusPolicy.ClickFocus
        button = Qt.FocusPolicy.TabFocus if selected else Qt.FocusPolicy.NoFocus
        self.amplitude.setFocusPolicy(number)
        for control in (self.mute, self.solo, self.remove):
            control.setFocusPolicy(button)
