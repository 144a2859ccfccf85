"""The colour bar of signed values: zero in the middle, the same limit either way."""

from PySide6.QtCore import QEvent, QRectF, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QVBoxLayout, QWidget

from skinsource.specs.fields import NumberSpec
from skinsource_gui.panels.skin.map_painter import small_font
from skinsource_gui.panels.skin.map_quantity import MapQuantity, Z
from skinsource_gui.panels.skin.scale.auto_button import AutoButton
from skinsource_gui.panels.skin.scale.colour_scale import paint_colour_scale
from skinsource_gui.panels.skin.scale.level_range import Range
from skinsource_gui.theme import UNIT_PX, current_theme, tabular
from skinsource_gui.widgets.fields.number_field import NumberField
from skinsource_gui.widgets.kept_picture import KeptPicture
from skinsource_gui.widgets.map.colour_maps import DIVERGING, colour_table
from skinsource_gui.widgets.tooltips import tooltip

_LIMIT = NumberSpec(
    label="Limit",
    unit="m/s²",
    minimum=1e-6,
    maximum=1e6,
    hint="Acceleration along z at the end of the colours, either way",
)
_RAMP_LEFT, _RAMP_WIDTH, _END_PX = 4, 14, 8


class SignedStrip(QWidget):
    """The colours, with ticks."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._range: Range = (-1.0, 1.0)
        self._matched = ""
        self._kept = KeptPicture()
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setMinimumHeight(70)

    def show_range(self, limits: Range) -> None:
        """Show other limits."""
        if limits != self._range:
            self._range = limits
            self.update()

    def show_matched(self, matched: str) -> None:
        """Say by how much it is louder or softer than it was stored."""
        if matched != self._matched:
            self._matched = matched
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setFont(tabular(small_font(self.font())))
        ground = self.palette().window().color()
        key = (self._range, current_theme(), self._matched)
        self._kept.paint(painter, QRectF(self.rect()), key, self._paint, ground)
        painter.end()

    def _paint(self, painter: QPainter) -> None:
        # Half of a number stands beyond either end.
        end = max(_END_PX, painter.fontMetrics().height() / 2)
        ramp = QRectF(_RAMP_LEFT, end, _RAMP_WIDTH, self.height() - 2 * end)
        limits, table = self._range, colour_table(DIVERGING)
        quantity = MapQuantity(name=Z, matched=self._matched)
        paint_colour_scale(painter, ramp, limits, limits, table, current_theme(), quantity)


class SignedBar(QWidget):
    """Colours from minus to plus a limit, a field for it, and a switch for the automatic one."""

    #: The limits that are wanted, or None for the automatic ones.
    limits_chosen = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._limits: Range = (-1.0, 1.0)
        self.limit = NumberField(_LIMIT, self)
        self.limit.setObjectName("z_limit")
        self.limit.setAccessibleName(_LIMIT.label)
        self.limit.setToolTip(tooltip(_LIMIT.label, _LIMIT.hint))
        self.limit.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.strip = SignedStrip(self)
        self.auto_button = AutoButton(
            "z_auto",
            "Automatic limit",
            "The limit follows the design: a quarter of the largest acceleration along z anywhere",
            self,
        )
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(UNIT_PX // 2)
        column.addWidget(self.limit)
        column.addWidget(self.strip, 1)
        column.addWidget(self.auto_button)
        self.setFixedWidth(self._width())
        self.limit.edited.connect(self._choose)
        self.auto_button.clicked.connect(self._switch)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self.setFixedWidth(self._width())

    def show_limits(self, limits: Range, *, automatic: bool) -> None:
        """Show limits, and whether they follow the design."""
        self._limits = limits
        self.limit.set_value(limits[1])
        self.strip.show_range(limits)
        self.auto_button.setChecked(automatic)

    def _choose(self, limit: float, _gesture: object) -> None:
        self.limits_chosen.emit((-limit, limit))

    def _switch(self, automatic: bool) -> None:
        self.limits_chosen.emit(None if automatic else self._limits)

    def _width(self) -> int:
        return self.fontMetrics().horizontalAdvance("0.0005 m/s²") + 2 * UNIT_PX
