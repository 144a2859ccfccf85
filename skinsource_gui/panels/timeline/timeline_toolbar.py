"""Buttons beside the ruler."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QToolButton, QWidget

from skinsource_gui.widgets.keys import KEYS
from skinsource_gui.widgets.room.room_or_words import RoomOrWords
from skinsource_gui.widgets.room.words_in_room import fitting_font, write_in

_ZOOM = 1.5


class TimelineToolbar(QWidget):
    """Snapping and zoom."""

    snaps_wanted = Signal(bool)
    zoom_wanted = Signal(float)
    everything_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setStyleSheet("QToolButton { padding: 1px 6px; }")
        self._row = row = QHBoxLayout(self)
        row.setContentsMargins(4, 1, 4, 1)
        row.setSpacing(2)
        self._snap = self._button(
            "Snap", "Edges snap to the grid, to ends of clips and to the playhead"
        )
        self._snap.setCheckable(True)
        self._snap.clicked.connect(self.snaps_wanted)
        self._closer = self._button("+", _hint("zoom_in"))
        self._closer.clicked.connect(self._zoom_in)
        self._wider = self._button("\u2212", _hint("zoom_out"))
        self._wider.clicked.connect(self._zoom_out)
        self._all = self._button("Fit", _hint("whole"))
        self._all.clicked.connect(self._see_all)
        self._buttons = (self._snap, self._wider, self._closer, self._all)
        for button in self._buttons:
            row.addWidget(button)
        row.addStretch(1)
        RoomOrWords(self).changed.connect(self._fit)

    def show_state(self, *, snaps: bool, zoomed: bool) -> None:
        """Whether edges snap; whether less than everything is seen."""
        self._snap.setChecked(snaps)
        self._all.setEnabled(zoomed)
        self._wider.setEnabled(zoomed)

    def _fit(self) -> None:
        # Heads do not become as wide as the largest letters, so that lanes have room.
        around = self._row.contentsMargins()
        gaps = around.left() + around.right() + self._row.spacing() * len(self._buttons)
        room = self.width() - gaps
        write_in(fitting_font((self._buttons,), self.font(), room), self._buttons)

    def _button(self, text: str, hint: str) -> QToolButton:
        button = QToolButton(self)
        button.setObjectName(f"timeline_{text.lower()}")
        button.setText(text)
        button.setToolTip(hint)
        button.setAccessibleName(hint)
        button.setAutoRaise(True)
        return button

    def _zoom_in(self) -> None:
        self.zoom_wanted.emit(_ZOOM)

    def _zoom_out(self) -> None:
        self.zoom_wanted.emit(1 / _ZOOM)

    def _see_all(self) -> None:
        self.everything_wanted.emit()


def _hint(name: str) -> str:
    gesture = KEYS["timeline"].gestures[name]
    return f"{gesture.effect[:1].upper()}{gesture.effect[1:]} ({gesture.shown})"
