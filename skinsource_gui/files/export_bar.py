"""How far an export is, and the way to stop it."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QSizePolicy,
    QWidget,
)

from skinsource_gui.theme import UNIT_PX, tabular

_BAR_PX, _NAME_PX = 96, 200
_STEPS = 1000


class ExportBar(QWidget):
    """Name of the file, a bar, and Cancel; hidden while nothing is exported."""

    cancel_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("export")
        self._path = ""
        self._name = QLabel()
        self._name.setObjectName("export_name")
        self._name.setAccessibleName("File that is being exported")
        self._percent = QLabel()
        self._percent.setObjectName("export_percent")
        self._percent.setFont(tabular(self.font()))
        self._percent.setMinimumWidth(self._percent.fontMetrics().horizontalAdvance("100 %"))
        self._percent.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self._bar = QProgressBar()
        self._bar.setObjectName("export_progress")
        self._bar.setAccessibleName("Progress of the export")
        self._bar.setTextVisible(False)
        self._bar.setFixedSize(_BAR_PX, UNIT_PX)
        self._cancel = QPushButton("Cancel")
        self._cancel.setObjectName("cancel_exporting")
        self._cancel.setToolTip("Stop this export; no file is left")
        self._cancel.setAccessibleName("Cancel the export")
        self._cancel.setAutoDefault(False)
        self._cancel.clicked.connect(self.cancel_wanted)
        # Where the bar it stands in has room to spare, it is not for this.
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        row = QHBoxLayout(self)
        row.setContentsMargins(UNIT_PX, 0, 0, 0)
        row.setSpacing(UNIT_PX)
        for widget in (self._name, self._bar, self._percent, self._cancel):
            row.addWidget(widget)
        self.hide()

    def show_order(self, path: str, name: str, waiting: int) -> None:
        """Show that ``name`` is being exported, and how many wait; "" hides the bar."""
        if path != self._path:
            self.show_progress(0, 0, "Computing")
        self._path = path
        more = f" (+{waiting})" if waiting else ""
        words = f"Exporting {name}"
        elided = self._name.fontMetrics().elidedText(words, Qt.TextElideMode.ElideMiddle, _NAME_PX)
        self._name.setText(elided + more)
        waits = f"\n{waiting} more to come" if waiting else ""
        self._name.setToolTip(f"{path}{waits}")
        # The keyboard goes back to where work is done.
        if not path and self._cancel.hasFocus():
            self.window().setFocus()
        self.setVisible(bool(path))

    def show_progress(self, done: int, total: int, text: str) -> None:
        """Show how far it is; a total of 0 while that is not known."""
        self._bar.setRange(0, _STEPS if total else 0)
        self._bar.setValue(_STEPS * done // total if total else 0)
        # A bar that only moves looks full.
        self._bar.setVisible(bool(total))
        self._percent.setText(f"{100 * done // total} %" if total else f"{text.lower()}…")
        self._bar.setToolTip(text)
