"""The colour bar: what the colours mean, and the range they span."""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QEvent, QSize, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QVBoxLayout, QWidget

from skinsource.signals.map_range import MAP_RANGE_DB, MAP_ROUND_TO_DB, map_range_db
from skinsource_gui.panels.skin.scale.auto_button import AutoButton
from skinsource_gui.panels.skin.scale.colour_strip import ColourStrip
from skinsource_gui.panels.skin.scale.level_field import high_field, low_field
from skinsource_gui.panels.skin.scale.level_range import (
    SILENT_RANGE,
    Range,
    pushed_high,
    pushed_low,
)
from skinsource_gui.theme import UNIT_PX, letter_scale

# So much of the strip is left at least, in letters of the usual size.
_STRIP_PX = 40


class ColourBar(QWidget):
    """A colour scale with fields for its ends and a switch for the automatic range."""

    #: A range in dB, or None for the automatic one.
    range_chosen = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._chosen: Range | None = None
        self.range_db: Range = SILENT_RANGE
        self.strip = ColourStrip(self)
        self.high_field, self.low_field = high_field(self), low_field(self)
        self.auto_button = AutoButton(
            "range_auto",
            "Automatic range",
            f"The range follows the loudest output: {MAP_RANGE_DB:g} dB, "
            f"up to the next {MAP_ROUND_TO_DB:g} dB",
            self,
        )
        self.auto_button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(UNIT_PX // 2)
        layout.addWidget(self.high_field)
        layout.addWidget(self.strip, 1)
        layout.addWidget(self.low_field)
        layout.addWidget(self.auto_button)
        for field in (self.high_field, self.low_field):
            field.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        order = (
            self.high_field,
            self.strip,
            self.strip.high,
            self.strip.low,
            self.low_field,
            self.auto_button,
        )
        for before, after in pairwise(order):
            self.setTabOrder(before, after)
        self.setFixedWidth(self._width())
        self.strip.range_chosen.connect(self.range_chosen)
        self.high_field.edited.connect(self._choose_high)
        self.low_field.edited.connect(self._choose_low)
        self.auto_button.clicked.connect(self._switch)
        self.choose(None)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        # The numbers matter more than the switch.
        fields = (self.high_field, self.low_field, self.auto_button)
        strip_px = round(_STRIP_PX * letter_scale(self.font()))
        needed = sum(part.sizeHint().height() for part in fields) + strip_px
        self.auto_button.setVisible(self.height() >= needed)

    def minimumSizeHint(self) -> QSize:
        # Without the switch, which goes where there is no room for it.
        parts = (self.high_field, self.strip, self.low_field)
        least = sum(part.minimumSizeHint().height() for part in parts)
        return QSize(self.width(), least + UNIT_PX)

    def event(self, event: QEvent) -> bool:
        done = super().event(event)
        # Letters of the strip may change after those of the bar.
        wanted = event.type() in (QEvent.Type.FontChange, QEvent.Type.LayoutRequest)
        if wanted and self.width() != self._width():
            self.setFixedWidth(self._width())
        return done

    def choose(self, range_db: Range | None) -> None:
        """Show a range, or the automatic one."""
        self._chosen = range_db
        self.auto_button.setChecked(range_db is None)
        self._show(self.range_db if range_db is None else range_db)

    def follow(self, levels_db: NDArray[np.float64]) -> None:
        """Let the automatic range follow the levels of all outputs."""
        if self._chosen is None:
            self._show(map_range_db(levels_db))

    def show_marks(self, marks: tuple[tuple[float, int], ...]) -> None:
        """Show levels of selected outputs, each in its colour."""
        self.strip.show_marks(marks)

    def _show(self, range_db: Range) -> None:
        self.range_db = range_db
        self.strip.show_range(range_db)
        self.low_field.set_value(round(range_db[0], 1))
        self.high_field.set_value(round(range_db[1], 1))

    def _choose_high(self, level_db: float) -> None:
        self.range_chosen.emit(pushed_high(self.range_db, level_db))

    def _choose_low(self, level_db: float) -> None:
        self.range_chosen.emit(pushed_low(self.range_db, level_db))

    def _switch(self, automatic: bool) -> None:
        self.range_chosen.emit(None if automatic else self.range_db)

    def _width(self) -> int:
        text = self.fontMetrics().horizontalAdvance("−199.9 dB")
        return max(self.strip.sizeHint().width(), text + 2 * UNIT_PX)
