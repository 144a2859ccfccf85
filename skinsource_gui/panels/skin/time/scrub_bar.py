"""Play, pause and scrub, below the map."""

from PySide6.QtCore import QEvent, QSize, Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSlider, QToolButton, QWidget

from skinsource_gui.panels.skin.map_quantity import time_text
from skinsource_gui.theme import UNIT_PX, tabular
from skinsource_gui.widgets.keys import shortcut_text
from skinsource_gui.widgets.tooltips import tooltip
from skinsource_gui.widgets.transport_icons import play_icon

# The slider counts tenths of a millisecond.
_PER_S = 10_000
# One press of an arrow key, and of Page Up.
_STEP, _PAGE = 10, 500


class ScrubBar(QWidget):
    """Shows where the playhead is, and tells where it shall be."""

    #: Where the playhead shall be, s.
    time_wanted = Signal(float)
    play_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._telling = True
        self.play = QToolButton(self)
        self.play.setObjectName("skin_play")
        self.play.setIconSize(QSize(14, 14))
        self.play.setAccessibleName("Play or stop")
        self.play.setToolTip(
            tooltip(
                f"Play or stop ({shortcut_text('play')})",
                f"{shortcut_text('pause')} stops where the playhead is, and goes on.",
            )
        )
        self.play.clicked.connect(self.play_wanted)
        self.slider = QSlider(Qt.Orientation.Horizontal, self)
        self.slider.setObjectName("skin_time")
        self.slider.setAccessibleName("Time")
        self.slider.setToolTip("Drag through time; arrow keys step by a millisecond")
        self.slider.setSingleStep(_STEP)
        self.slider.setPageStep(_PAGE)
        self.slider.valueChanged.connect(self._tell)
        self.words = QLabel(self)
        self.words.setFont(tabular(self.words.font()))
        self.words.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(UNIT_PX // 2)
        row.addWidget(self.play)
        row.addWidget(self.slider, 1)
        row.addWidget(self.words)
        self.play.setIcon(play_icon())

    def show_time(self, time_s: float, end_s: float) -> None:
        """Show where the playhead is, in a response that ends there; tell nobody."""
        self._telling = False
        self.slider.setMaximum(max(round(end_s * _PER_S), 1))
        self.slider.setValue(round(time_s * _PER_S))
        self._telling = True
        self.words.setText(time_text(time_s))
        # As wide as its widest words, so that the slider stays.
        widest = self.words.fontMetrics().horizontalAdvance(time_text(max(end_s, time_s)) + "0")
        if self.words.minimumWidth() != widest:
            self.words.setMinimumWidth(widest)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self.play.setIcon(play_icon())

    def _tell(self, tenths_ms: int) -> None:
        if self._telling:
            self.time_wanted.emit(tenths_ms / _PER_S)
