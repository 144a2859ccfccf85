"""One input in a list: what it is, and what is changed most often."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QEvent, QObject, QRect, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QFont, QPainter, QPen, QResizeEvent
from PySide6.QtWidgets import QWidget

from skinsource.design import AMPLITUDE, Input
from skinsource.locations import input_words
from skinsource_gui.theme import LIGHT, UNIT_PX, Theme
from skinsource_gui.widgets.fields.number_field import NumberField
from skinsource_gui.widgets.inputs.input_words import duration_text, figure_text
from skinsource_gui.widgets.inputs.letter_button import (
    BUTTON_PX,
    mute_button,
    remove_button,
    solo_button,
)
from skinsource_gui.widgets.inputs.swatch import SWATCH_PX, paint_swatch
from skinsource_gui.widgets.inputs.waveform_preview import WaveformPreview

#: Height of a row; it is lower where everything stands in one line of columns.
ROW_PX, LOW_ROW_PX = 48, 36
#: From this width on, everything stands in one line of columns.
WIDE_PX = 420

_LINE_PX, _LOW_LINE_PX = 20, 16
_FIRST_LINE_PX = 3
_TEXT_LEFT_PX = UNIT_PX + SWATCH_PX + UNIT_PX
# Room for the words of most inputs.
_TEXT_PX = 172
_AMPLITUDE_PX = 84
_PREVIEW_PX = 64
_MARK_PX = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class RowState:
    """What a row shows.

    Attributes
    ----------
    shown
        The input.
    silent
        Whether it is not heard, for being muted or because another is solo.
    selected, last, list_focused
        Whether the row is selected; whether it is the one that was selected last; whether keys go
        to the list.
    unit
        Of the amplitude.
    """

    shown: Input
    silent: bool
    selected: bool
    last: bool
    list_focused: bool
    unit: str


class InputRow(QWidget):
    """A row of the list of inputs.  Its signals begin with the id of its input."""

    #: The keyboard went to its number.
    entered = Signal(int)
    amplitude_edited = Signal(int, float, object)
    mute_toggled = Signal(int)
    solo_toggled = Signal(int)
    removed = Signal(int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = LIGHT
        self._state: RowState | None = None
        self.setObjectName("input_row")
        self.setFixedHeight(ROW_PX)
        self.preview = WaveformPreview(self)
        self.preview.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.amplitude = NumberField(AMPLITUDE, self)
        self.amplitude.setObjectName("amplitude_field")
        # The theme's fields are as high as a line of a form, too high for two lines in a row.
        self.amplitude.setStyleSheet("QLineEdit { min-height: 0; padding: 0 4px; }")
        self.mute, self.solo, self.remove = (
            mute_button(self),
            solo_button(self),
            remove_button(self),
        )
        self.amplitude.edited.connect(self._edit_amplitude)
        self.amplitude.installEventFilter(self)
        self.mute.clicked.connect(self._toggle_mute)
        self.solo.clicked.connect(self._toggle_solo)
        self.remove.clicked.connect(self._remove)

    @property
    def controls(self) -> tuple[QWidget, ...]:
        """What the keyboard can reach, in its order."""
        return (self.amplitude, self.mute, self.solo, self.remove)

    @property
    def id(self) -> int:
        """Id of its input."""
        return self._state.shown.id

    @property
    def state(self) -> RowState | None:
        """What is shown."""
        return self._state

    def show_state(self, state: RowState) -> None:
        """Show an input."""
        if state == self._state:
            return
        old, self._state = self._state, state
        shown = state.shown
        self.amplitude.set_spec(replace(AMPLITUDE, unit=state.unit))
        self.amplitude.set_value(shown.amplitude)
        self.mute.setChecked(shown.muted)
        self.solo.setChecked(shown.solo)
        if old is None or old.last != state.last:
            self._let_keyboard_in(state.last)
        self._show_look()
        place = input_words(shown.location)
        self.setAccessibleName(
            f"Input at {place.number}, {place.name}: {figure_text(shown.waveform)}"
            f"{', silent' if state.silent else ''}"
        )
        self.setToolTip(f"{place.number} · {place.name}\n{self._figure()}")
        if old is None or _frame(old) != _frame(state):
            self.update()
        else:
            # Words alone: the controls beside them look after themselves.
            self.update(0, 0, self._words_end(), self.height())

    def show_samples(self, samples: NDArray[np.float64]) -> None:
        """Show what the input plays, (n_times,)."""
        # Miniatures have no axis: any rate shows the whole of it, also of a single sample.
        self.preview.show_samples(samples, float(max(samples.size, 8)))

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        for part in (self.preview, *self.controls):
            part.show_theme(theme)
        self._show_look()
        self.update()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if watched is self.amplitude and event.type() == QEvent.Type.FocusIn:
            self.entered.emit(self.id)
        return super().eventFilter(watched, event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        right = self.width() - UNIT_PX
        wide = self.width() >= WIDE_PX
        row_px = LOW_ROW_PX if wide else ROW_PX
        self.setFixedHeight(row_px)
        button_px = BUTTON_PX if wide else _LINE_PX
        for button in (self.remove, self.solo, self.mute):
            right -= button_px + 2
            top = (row_px - button_px) // 2 if wide else _FIRST_LINE_PX
            button.setGeometry(right, top, button_px, button_px)
        if wide:
            right -= UNIT_PX + _AMPLITUDE_PX
            self.amplitude.setGeometry(right, (row_px - 26) // 2, _AMPLITUDE_PX, 26)
            right -= UNIT_PX
            preview_px = max(_PREVIEW_PX, right - _TEXT_LEFT_PX - _TEXT_PX)
            right -= preview_px
            self.preview.setGeometry(right, 5, preview_px, row_px - 10)
        else:
            self.amplitude.setGeometry(
                self.width() - UNIT_PX - _AMPLITUDE_PX,
                _FIRST_LINE_PX + _LINE_PX + 2,
                _AMPLITUDE_PX,
                _LINE_PX + 1,
            )
            right -= UNIT_PX + _PREVIEW_PX
            self.preview.setGeometry(right, _FIRST_LINE_PX, _PREVIEW_PX, _LINE_PX)

    def paintEvent(self, event) -> None:
        if self._state is None:
            return
        painter = QPainter(self)
        self._paint_back(painter)
        shown, silent = self._state.shown, self._state.silent
        left = UNIT_PX
        paint_swatch(
            painter,
            QRectF(left, (self.height() - SWATCH_PX) / 2, SWATCH_PX, SWATCH_PX),
            shown.location,
            self._theme.input_colour(shown.colour),
            QColor(self._theme.text),
            silent=silent,
        )
        left = _TEXT_LEFT_PX
        place = input_words(shown.location)
        line_px = _LOW_LINE_PX if self.height() == LOW_ROW_PX else _LINE_PX
        name = QRect(left, _FIRST_LINE_PX, self.preview.x() - UNIT_PX - left, line_px)
        painter.setPen(QColor(self._theme.dim if silent else self._theme.text))
        font = QFont(painter.font())
        font.setWeight(QFont.Weight.Medium)
        painter.setFont(font)
        fits = painter.fontMetrics().horizontalAdvance(place.name) <= name.width()
        short_name = place.short_name[0].upper() + place.short_name[1:]
        self._write(painter, name, place.name if fits else short_name)
        painter.setFont(self.font())
        painter.setPen(QColor(self._theme.dim))
        end = self._words_end() - UNIT_PX
        figure = QRect(left, _FIRST_LINE_PX + line_px, end - left, line_px)
        self._write(painter, figure, self._figure())

    def _paint_back(self, painter: QPainter) -> None:
        painter.setPen(QPen(QColor(self._theme.border), 1))
        bottom = self.height() - 1
        painter.drawLine(UNIT_PX, bottom, self.width() - UNIT_PX, bottom)
        if not self._state.selected:
            return
        tint = QColor(self._theme.accent)
        if self._state.last:
            painter.fillRect(0, 0, _MARK_PX, self.height(), tint)
        if self._state.last and self._state.list_focused:
            painter.setPen(QPen(tint, 2))
            painter.drawRect(QRectF(self.rect()).adjusted(1, 1, -1, -1))
        tint.setAlpha(28)
        painter.fillRect(self.rect(), tint)

    def _write(self, painter: QPainter, place: QRect, text: str) -> None:
        shown = painter.fontMetrics().elidedText(text, Qt.TextElideMode.ElideRight, place.width())
        flags = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
        painter.drawText(place, flags, shown)

    def _words_end(self) -> int:
        # In a narrow row, the preview stands above the field, and not so far to the right.
        return self.preview.x() if self.width() >= WIDE_PX else self.amplitude.x()

    def _figure(self) -> str:
        waveform = self._state.shown.waveform
        return f"{figure_text(waveform)} · {duration_text(waveform)}"

    def _show_look(self) -> None:
        if self._state is None:
            return
        shown = self._state.shown
        colour = self._theme.input_colour(shown.colour)
        self.preview.set_look(
            QColor(self._theme.dim) if self._state.silent else colour,
            flipped=shown.amplitude < 0,
        )

    def _let_keyboard_in(self, selected: bool) -> None:
        # One row at a time: twenty rows of four stops each would be a long way.
        number = Qt.FocusPolicy.StrongFocus if selected else Qt.FocusPolicy.ClickFocus
        button = Qt.FocusPolicy.TabFocus if selected else Qt.FocusPolicy.NoFocus
        self.amplitude.setFocusPolicy(number)
        for control in (self.mute, self.solo, self.remove):
            control.setFocusPolicy(button)

    def _edit_amplitude(self, value: float, gesture: int | None) -> None:
        self.amplitude_edited.emit(self.id, value, gesture)

    def _toggle_mute(self) -> None:
        self.mute_toggled.emit(self.id)

    def _toggle_solo(self) -> None:
        self.solo_toggled.emit(self.id)

    def _remove(self) -> None:
        self.removed.emit(self.id)


def _frame(state: RowState) -> tuple[bool, bool, bool]:
    return state.selected, state.last, state.list_focused
