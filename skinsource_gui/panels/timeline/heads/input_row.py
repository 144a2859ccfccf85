"""Head of one track: where it plays, and what is changed most often."""

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QWidget

from skinsource.design.design import AMPLITUDE
from skinsource.limbs.locations import input_words
from skinsource_gui.panels.timeline.heads.row_picture import paint_row
from skinsource_gui.panels.timeline.heads.row_places import ROW_PX, row_places
from skinsource_gui.panels.timeline.heads.row_signals import RowSignals
from skinsource_gui.panels.timeline.heads.row_state import RowState
from skinsource_gui.theme import current_theme
from skinsource_gui.widgets.fields.number_field import NumberField
from skinsource_gui.widgets.inputs.letter_button import (
    LetterButton,
    mute_button,
    remove_button,
    solo_button,
)
from skinsource_gui.widgets.tooltips import show_tooltip


class InputRow(QWidget):
    """The head of a track, which tells by ``signals`` what is done to it."""

    def __init__(self, signals: RowSignals, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._signals = signals
        self._state: RowState | None = None
        self.setObjectName("input_row")
        self._places = row_places(self.width())
        self.setFixedHeight(ROW_PX)
        self.amplitude = NumberField(AMPLITUDE, self, widest_unit="")
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
    def controls(self) -> tuple[NumberField | LetterButton, ...]:
        """What the keyboard can reach, in its order."""
        return (self.amplitude, self.mute, self.solo, self.remove)

    @property
    def id(self) -> int:
        """Id of its input."""
        return self.state.shown.id

    @property
    def state(self) -> RowState:
        """What is shown; only a row that shows something is asked."""
        if self._state is None:
            raise LookupError("this row shows no input yet")
        return self._state

    def show_state(self, state: RowState) -> None:
        """Show an input."""
        if state == self._state:
            return
        old, self._state = self._state, state
        shown = state.shown
        self.amplitude.set_spec(state.amplitude)
        self.amplitude.set_value(shown.amplitude)
        self.mute.setChecked(shown.muted)
        self.solo.setChecked(shown.solo)
        if old is None or old.last != state.last:
            self._let_keyboard_in(state.last)
        place = input_words(shown.location, state.limb)
        self.setAccessibleName(
            f"Input at {place.number}, {place.name}: {state.title}"
            f"{', silent' if state.silent else ''}"
        )
        peak = f"\nPeak {state.peak}" if state.peak else ""
        show_tooltip(self, f"{place.number} · {place.name}\n{state.figure}{peak}")
        if bool(state.peak) != bool(old and old.peak):
            self._lay_out()
        if old is None or old.frame != state.frame:
            self.update()
        elif old.words != state.words:
            # These alone: the controls beside them look after themselves.
            self.update(self._places.words)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if watched is self.amplitude and event.type() == QEvent.Type.FocusIn:
            self._signals.entered.emit(self.id)
        return super().eventFilter(watched, event)

    def resizeEvent(self, event: QResizeEvent) -> None:
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

    def paintEvent(self, event: QPaintEvent) -> None:
        if self._state is not None:
            painter = QPainter(self)
            paint_row(painter, self._state, self._places, current_theme())

    def _let_keyboard_in(self, selected: bool) -> None:
        # One row at a time: twenty rows of four stops each would be a long way.
        number = Qt.FocusPolicy.StrongFocus if selected else Qt.FocusPolicy.ClickFocus
        button = Qt.FocusPolicy.TabFocus if selected else Qt.FocusPolicy.NoFocus
        self.amplitude.setFocusPolicy(number)
        for control in (self.mute, self.solo, self.remove):
            control.setFocusPolicy(button)

    def _edit_amplitude(self, value: float, gesture: int | None) -> None:
        self._signals.amplitude_edited.emit(self.id, value, gesture)

    def _toggle_mute(self) -> None:
        self._signals.mute_toggled.emit(self.id)

    def _toggle_solo(self) -> None:
        self._signals.solo_toggled.emit(self.id)

    def _remove(self) -> None:
        self._signals.removed.emit(self.id)
