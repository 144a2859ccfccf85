"""The row of switches above a plot."""

from collections.abc import Callable

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QButtonGroup, QHBoxLayout, QSizePolicy, QToolButton, QWidget

from skinsource_gui.theme import UNIT_PX

TOOLBAR_HEIGHT_PX = 28
_LAYOUTS = (
    ("overlaid", "Overlaid", "All curves over each other"),
    ("stacked", "Stacked", "Each curve in its own row, all with the same scale"),
)


class PlotToolbar(QWidget):
    """Overlaid or stacked, switches of one plot, and the way out of a zoom.

    Buttons say what the user wants; what they show is set from outside.
    """

    #: ``"overlaid"`` or ``"stacked"``.
    layout_chosen = Signal(str)
    everything_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        # As high as its words need, where they are large.
        self.setMinimumHeight(TOOLBAR_HEIGHT_PX)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self._row = QHBoxLayout(self)
        self._row.setContentsMargins(UNIT_PX // 2, 1, UNIT_PX // 2, 1)
        self._row.setSpacing(UNIT_PX // 2)
        self._layouts = QButtonGroup(self)
        self._layout_buttons: dict[str, QToolButton] = {}
        segments = QHBoxLayout()
        segments.setSpacing(0)
        for name, text, hint in _LAYOUTS:
            button = self._button(name, text, hint)
            self._layouts.addButton(button)
            segments.addWidget(button)
            self._layout_buttons[name] = button
            self._last_before_switches = button
        self._layouts.buttonClicked.connect(self._choose_layout)
        self._row.addLayout(segments)
        self._row.addStretch(1)
        self._everything = self._button("show-all", "Show all", "Leave the zoom (key 0)")
        self._everything.setCheckable(False)
        self._everything.clicked.connect(self.everything_wanted)
        self._everything.setVisible(False)
        self._row.addWidget(self._everything)

    def add_switch(
        self, name: str, text: str, hint: str, toggled: Callable[[bool], None]
    ) -> QToolButton:
        """Return a new switch; ``toggled`` is told what the user wants it to be."""
        button = self._button(name, text, hint)
        button.clicked.connect(toggled)
        self._row.insertWidget(self._row.count() - 2, button)
        # Tab goes from left to right, whenever a switch was made.
        QWidget.setTabOrder(self._last_before_switches, button)
        self._last_before_switches = button
        return button

    def show_state(self, *, layout: str, zoomed: bool) -> None:
        """Show which layout there is, and whether a zoom can be left."""
        self._layout_buttons[layout].setChecked(True)
        if not zoomed and self._everything.hasFocus():
            self._layout_buttons[layout].setFocus(Qt.FocusReason.OtherFocusReason)
        self._everything.setVisible(zoomed)

    def _button(self, name: str, text: str, hint: str) -> QToolButton:
        button = QToolButton(self)
        button.setObjectName(name)
        button.setText(text)
        button.setToolTip(hint)
        button.setAccessibleName(text)
        button.setAccessibleDescription(hint)
        button.setCheckable(True)
        button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        return button

    def _choose_layout(self, button: QToolButton) -> None:
        self.layout_chosen.emit(button.objectName())
