"""Which input is being edited."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QWidget

from skinsource.design.design import Input
from skinsource.limbs.locations import PlaceWords, input_words
from skinsource_gui.theme import UNIT_PX, set_tone
from skinsource_gui.widgets.inputs.letter_button import mute_button, solo_button
from skinsource_gui.widgets.inputs.swatch import Swatch
from skinsource_gui.widgets.room.room_or_words import RoomOrWords
from skinsource_gui.widgets.tooltips import show_tooltip


class InputHeading(QWidget):
    """Colour, number and name of an input's place, with its mute and solo buttons."""

    mute_toggled = Signal()
    solo_toggled = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._place: PlaceWords | None = None
        self._before = ""
        self._swatch = Swatch()
        self._words = QLabel()
        self._words.setObjectName("inspector_heading")
        self._words.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        font = QFont(self.font())
        font.setWeight(QFont.Weight.DemiBold)
        self._words.setFont(font)
        self._state = QLabel()
        set_tone(self._state, "warning")
        self._mute, self._solo = mute_button(), solo_button()
        self._row = layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(UNIT_PX // 2)
        layout.addWidget(self._swatch)
        layout.addSpacing(UNIT_PX // 2)
        layout.addWidget(self._words, 1)
        layout.addWidget(self._state)
        layout.addWidget(self._mute)
        layout.addWidget(self._solo)
        RoomOrWords(self).changed.connect(self._fit_words)
        self._mute.clicked.connect(self.mute_toggled)
        self._solo.clicked.connect(self.solo_toggled)

    def show_input(
        self, shown: Input, limb: str, *, silent: bool, together: tuple[Input, ...]
    ) -> None:
        """Show an input, ``silent`` unless it is heard, of those that are edited ``together``."""
        self._before = f"{len(together)} inputs, last: " if len(together) > 1 else ""
        place = input_words(shown.location, limb)
        self._place = place
        self._swatch.show_input(shown.location, shown.colour, silent=silent)
        contact = f" ({place.kind})" if place.kind else ""
        show_tooltip(self._words, f"Input place {place.number}: {place.name}{contact}")
        of_whom = "last silent" if len(together) > 1 else "silent"
        self._state.setText(of_whom if silent else "")
        self._mute.setChecked(all(one.muted for one in together))
        self._solo.setChecked(all(one.solo for one in together))
        self._fit_words()

    def _fit_words(self) -> None:
        if self._place is None:
            return
        self._row.activate()
        metrics, room = self._words.fontMetrics(), self._words.width()
        name = f"{self._before}{self._place.name}"
        if metrics.horizontalAdvance(name) > room:
            short = f"{self._before}{self._place.short_name}"
            name = metrics.elidedText(
                short[0].upper() + short[1:], Qt.TextElideMode.ElideRight, room
            )
        self._words.setText(name)
