"""What is said of each condition, and a button where something can be done."""

from functools import partial

from PySide6.QtCore import QPoint, Qt, Signal
from PySide6.QtWidgets import QFrame, QGridLayout, QLabel, QPushButton, QWidget

from skinsource.perception.validity import Finding, Findings
from skinsource_gui.status.validity_lamps import STATES
from skinsource_gui.theme import UNIT_PX, set_tone

_TITLES = {
    "inputs": "Inputs",
    "band": "Measured band",
    "drive": "Velocity of the probe",
    "spacing": "Spacing of the outputs",
    "noise": "Signal to noise",
    "limb": "Limb",
    "scaling": "Scaling",
}
_MENDS = {
    "band_limit": "Limit to the band",
    "quieter": "Play within it",
    "probe_scaling": "Use probe scaling",
    "deselect": "Deselect them",
}
_WORDS_EM = 28


class ValidityCard(QFrame):
    """A card over the status bar; it goes at the next click elsewhere, or with Esc."""

    #: The `Finding` that shall be mended.
    mend_wanted = Signal(object)

    def __init__(self, findings: Findings, first: str, parent: QWidget) -> None:
        super().__init__(parent, Qt.WindowType.Popup)
        self.setObjectName("validity_card")
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setFrameShape(QFrame.Shape.StyledPanel)
        grid = QGridLayout(self)
        grid.setContentsMargins(UNIT_PX, UNIT_PX, UNIT_PX, UNIT_PX)
        grid.setHorizontalSpacing(2 * UNIT_PX)
        grid.setVerticalSpacing(UNIT_PX)
        grid.setColumnStretch(1, 1)
        for row, one in enumerate(findings):
            self._add(grid, row, one, chosen=one.name == first)

    def open_above(self, place: QPoint) -> None:
        """Show it with its lower edge at a place of the screen."""
        self.adjustSize()
        screen = self.screen().availableGeometry()
        left = min(max(place.x(), screen.left()), screen.right() - self.width())
        self.move(left, max(place.y() - self.height() - 2, screen.top()))
        self.show()

    def _add(self, grid: QGridLayout, row: int, one: Finding, *, chosen: bool) -> None:
        title = QLabel(f"{_TITLES[one.name]}\n{STATES[one.state]}")
        set_tone(title, "warning" if one.state == "left" else "dim")
        font = title.font()
        font.setBold(chosen)
        title.setFont(font)
        words = QLabel(one.sentence)
        words.setObjectName(f"validity_{one.name}")
        words.setWordWrap(True)
        # Wrapped words are as high as their width makes them, which grids forget.
        wide = _WORDS_EM * self.fontMetrics().horizontalAdvance("m")
        words.setFixedWidth(wide)
        words.setFixedHeight(words.heightForWidth(wide))
        top = Qt.AlignmentFlag.AlignTop
        grid.addWidget(title, row, 0, top)
        grid.addWidget(words, row, 1, top)
        if one.mend:
            button = QPushButton(_MENDS[one.mend])
            button.setObjectName(f"mend_{one.name}")
            button.clicked.connect(partial(self._mend, one))
            grid.addWidget(button, row, 2, top)
            if chosen:
                button.setFocus()

    def _mend(self, finding: Finding) -> None:
        self.close()
        self.mend_wanted.emit(finding)
