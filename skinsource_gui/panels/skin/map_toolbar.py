"""Buttons of the map."""

from PySide6.QtCore import QEvent, QSize, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QButtonGroup, QHBoxLayout, QToolButton, QWidget

from skinsource_gui.panels.skin.map_icons import fit_icon, hand_icon, sensors_icon
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.panels.skin.stage.map_layout import HAND
from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.keys import key_text
from skinsource_gui.widgets.pan_zoom import WHOLE
from skinsource_gui.widgets.tool_button import tool_button

# As narrow as they are, all buttons fit into the narrowest panel.
_ICON_BUTTON_PX = 33


class MapToolbar(QWidget):
    """Style of the map, its sensors, and what part of it is seen."""

    #: ``"interpolated"`` or ``"sensors"``.
    style_chosen = Signal(str)
    sensors_switched = Signal(bool)
    #: `WHOLE` or `HAND`.
    fit_chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.interpolated = self._button(
            "map_interpolated", "Interpolated", "Colours over the skin"
        )
        self.sensors_only = self._button(
            "map_sensors_only", "Sensors only", "Colours at the outputs alone"
        )
        self.sensors = self._button("map_sensors_shown", "", "Mark the outputs on the map")
        whole, hand = (key_text("skin", name) for name in ("whole", "hand"))
        fit = f"Fit hand and arm ({whole}, or double-click)"
        self.all = self._button("map_fit_all", "", fit, False)
        self.hand = self._button("map_fit_hand", "", f"Fit the hand ({hand})", False)
        self.sensors.setAccessibleName("Sensors")
        self.all.setAccessibleName("Fit")
        self.hand.setAccessibleName("Hand")
        for button in (self.sensors, self.all, self.hand):
            button.setFixedWidth(_ICON_BUTTON_PX)
        self._show_icons()
        styles = QButtonGroup(self)
        styles.addButton(self.interpolated)
        styles.addButton(self.sensors_only)
        self._row = row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(1)
        row.addWidget(self.interpolated)
        row.addWidget(self.sensors_only)
        row.addSpacing(UNIT_PX // 4)
        row.addWidget(self.sensors)
        row.addStretch(1)
        row.addWidget(self.all)
        row.addWidget(self.hand)
        self.interpolated.clicked.connect(self._choose_interpolated)
        self.sensors_only.clicked.connect(self._choose_sensors)
        self.sensors.clicked.connect(self.sensors_switched)
        self.all.clicked.connect(self._choose_all)
        self.hand.clicked.connect(self._choose_hand)

    def show_settings(self, settings: SkinSettings) -> None:
        """Show the present choice."""
        interpolated = settings.map_style == "interpolated"
        self.interpolated.setChecked(interpolated)
        self.sensors_only.setChecked(not interpolated)
        self.sensors.setEnabled(interpolated)
        self.sensors.setChecked(settings.sensors_shown or not interpolated)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._show_icons()

    def _show_icons(self) -> None:
        self.sensors.setIcon(sensors_icon())
        self.all.setIcon(fit_icon())
        self.hand.setIcon(hand_icon())

    def minimumSizeHint(self) -> QSize:
        # Without the fits, which go where there is no room for them.
        every = (self.interpolated, self.sensors_only, self.sensors)
        width = sum(part.minimumSizeHint().width() for part in every) + UNIT_PX
        return QSize(width, super().minimumSizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        # Where there is no room for all, the fits are left to the menu and to keys.
        row, every = self._row, (self.interpolated, self.sensors_only, self.sensors)
        fits = (self.all, self.hand)
        needed = sum(part.sizeHint().width() for part in every) + len(fits) * _ICON_BUTTON_PX
        roomy = self.width() >= needed + row.spacing() * (row.count() + 1)
        for part in fits:
            part.setVisible(roomy)

    def _button(self, name: str, text: str, hint: str, checkable: bool = True) -> QToolButton:
        button = tool_button(self, name, text, hint, checkable=checkable)
        button.setIconSize(QSize(16, 16))
        return button

    def _choose_interpolated(self) -> None:
        self.style_chosen.emit("interpolated")

    def _choose_sensors(self) -> None:
        self.style_chosen.emit("sensors")

    def _choose_all(self) -> None:
        self.fit_chosen.emit(WHOLE)

    def _choose_hand(self) -> None:
        self.fit_chosen.emit(HAND)
