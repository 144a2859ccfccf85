"""What the map shows: levels, or the skin in time; and how slowly that is played."""

from PySide6.QtCore import QEvent, Signal
from PySide6.QtWidgets import QHBoxLayout, QWidget

from skinsource.specs.fields import ChoiceSpec
from skinsource_gui.panels.skin.map_quantity import RMS, STILL
from skinsource_gui.panels.skin.settings import QUANTITY, RMS_WINDOW, SkinSettings
from skinsource_gui.panels.skin.time.pace import PACES
from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.fields.choice_field import ChoiceField
from skinsource_gui.widgets.fields.number_field import NumberField
from skinsource_gui.widgets.tooltips import tooltip

PACE = ChoiceSpec(
    label="Speed",
    options=tuple((str(pace), f"1/{pace}") for pace in PACES),
    hint="How fast time runs while it plays; below 1/1 it is seen, and not heard",
)
_PACE_PX, _WINDOW_PX = 76, 66
# Beside the words of a list: its arrow and edges.
_ARROW_PX = 40


class QuantityRow(QWidget):
    """Shows what is chosen, and tells what is wanted."""

    #: Name of what the map shall show.
    quantity_chosen = Signal(str)
    #: How many times slower it shall be played.
    pace_chosen = Signal(float)
    #: Length of the sliding window, s.
    window_chosen = Signal(float)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.quantity = ChoiceField(QUANTITY, self)
        self.quantity.setObjectName("skin_quantity")
        self.rms_window = NumberField(RMS_WINDOW, self, widest_unit="ms")
        self.rms_window.setObjectName("skin_rms_window")
        self.rms_window.setAccessibleName(RMS_WINDOW.label)
        self.rms_window.setToolTip(tooltip(RMS_WINDOW.label, RMS_WINDOW.hint))
        self.pace = ChoiceField(PACE, self)
        self.pace.setObjectName("skin_pace")
        self.pace.setMinimumContentsLength(4)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(UNIT_PX // 2)
        row.addWidget(self.quantity, 1)
        row.addWidget(self.rms_window)
        row.addWidget(self.pace)
        self._fit()
        self.quantity.chosen.connect(self._choose_quantity)
        self.pace.chosen.connect(self._choose_pace)
        self.rms_window.edited.connect(self._choose_window)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._fit()

    def show_settings(self, settings: SkinSettings, slow_motion: float) -> None:
        """Show the present choice."""
        self.quantity.set_value(settings.quantity)
        self.rms_window.setVisible(settings.quantity == RMS)
        self.rms_window.set_value(settings.rms_window_s)
        self.pace.setVisible(settings.quantity not in STILL)
        self.pace.set_value(f"{slow_motion:g}")

    def _fit(self) -> None:
        metrics = self.fontMetrics()
        pace = metrics.horizontalAdvance("1/200") + _ARROW_PX
        window = metrics.horizontalAdvance("500 ms") + 3 * UNIT_PX
        self.pace.setFixedWidth(max(_PACE_PX, pace))
        self.rms_window.setFixedWidth(max(_WINDOW_PX, window))

    def _choose_quantity(self, name: str, _gesture: object) -> None:
        self.quantity_chosen.emit(name)

    def _choose_pace(self, pace: str, _gesture: object) -> None:
        self.pace_chosen.emit(float(pace))

    def _choose_window(self, window_s: float, _gesture: object) -> None:
        self.window_chosen.emit(window_s)
