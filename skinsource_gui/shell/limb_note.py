"""The line that says that a limb is not a measured one, or not made from the published files."""

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QSize, Qt, Signal

from skinsource.limbs.dataset.store import NOT_INSTALLED
from skinsource.limbs.own_limbs import facts_of, missing_limb
from skinsource_gui.qt.theme import current_theme
from skinsource_gui.state.engine import Outcome

_LINKS = (
    Qt.TextInteractionFlag.LinksAccessibleByMouse | Qt.TextInteractionFlag.LinksAccessibleByKeyboard
)
_SYNTHETIC = "Computed from a model of the arm, not measured on a person"
_TAB_REASONS = (Qt.FocusReason.TabFocusReason, Qt.FocusReason.BacktabFocusReason)


class LimbNote(QtWidgets.QLabel):
    """Says SYNTHETIC LIMB where it is one, and the way to the measured ones if they are missing.

    Of a measured limb it says what there is to note, such as that it was not made from the
    published files; of one that is not here, only that.
    """

    help_requested = Signal()

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("limb_note")
        self._measured = False
        self._synthetic = False
        self._limb = self._note = self._own = self._missing = ""
        self._shown_state: tuple[object, ...] = ()
        # Words and their HTML, longest first.
        self._phrases: tuple[tuple[str, str], ...] = (("", ""),)
        self.setTextFormat(Qt.TextFormat.RichText)
        self.setAccessibleName("Kind of limb")
        self.linkActivated.connect(self.help_requested)

    def show_available(self, limbs: tuple[str, ...]) -> None:
        """Take over which limbs are installed."""
        self._measured = any(name.startswith("measured") for name in limbs)
        self._show_text()

    def show_limb(self, name: str) -> None:
        """Show what there is to say about the limb ``name``."""
        if name != self._limb:
            self._limb, self._note = name, ""
        facts = facts_of(name)
        self._synthetic = facts.synthetic
        self._own = facts.sentence if facts.own else ""
        self._missing = missing_limb(name, "") if facts.missing else ""
        self._show_text()

    def show_outcome(self, outcome: Outcome) -> None:
        """Show what there is to note of the limb that was looked at."""
        note = outcome.values["limb_data"].note if outcome.values else ""
        if note != self._note:
            self._note = note
            self._show_text()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._show_text()

    def focusInEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusInEvent(event)
        if event.reason() in _TAB_REASONS:
            # Straight to the link, which Enter follows then.
            super().focusNextPrevChild(True)

    def _show_text(self) -> None:
        state = (
            self._synthetic,
            self._note,
            self._own,
            self._missing,
            self._measured,
            current_theme(),
        )
        if state == self._shown_state:
            return  # else the window is laid out anew at each edit
        self._shown_state = state
        self.setVisible(any((self._synthetic, self._note, self._own, self._missing)))
        note = f"{self._note[:1].upper()}{self._note[1:]}"
        self.setToolTip(self._missing or f"{self._own} {note}".strip() or _SYNTHETIC)
        colour = current_theme().warning
        other = ("OWN LIMB",) if self._own else ("NOT VERIFIED AS PUBLISHED", "NOT VERIFIED")
        labels = ("SYNTHETIC LIMB",) if self._synthetic else other
        # What was noted of the results before is of another limb.
        labels = ("LIMB MISSING",) if self._missing else labels
        label = labels[0]
        self._phrases = tuple((label, f"<b>{label}</b>") for label in labels)
        linked = self._synthetic and not self._measured and not self._own
        if linked:
            start = f"<a href='#get' style='color:{colour}'>"
            self._phrases = (
                (
                    f"{label} · {NOT_INSTALLED} How to get them",
                    f"<b>{label}</b> · {NOT_INSTALLED} {start}How to get them</a>",
                ),
                (
                    f"{label} · Measured limbs",
                    f"<b>{label}</b> · {start}Measured limbs</a>",
                ),
                (label, f"<b>{start}{label}</a></b>"),
            )
        # Without a link there is nothing for the keyboard.
        self.setTextInteractionFlags(_LINKS if linked else Qt.TextInteractionFlag.NoTextInteraction)
        self._choose()
        self.updateGeometry()

    def sizeHint(self) -> QSize:
        return QSize(self._width_of(self._phrases[0][0]), super().sizeHint().height())

    def minimumSizeHint(self) -> QSize:
        return QSize(self._width_of(self._phrases[-1][0]), super().minimumSizeHint().height())

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._choose()

    def _choose(self) -> None:
        fitting = (html for text, html in self._phrases if self._width_of(text) <= self.width())
        html = next(fitting, self._phrases[-1][1])
        text = f"<span style='color:{current_theme().warning}'>{html}</span>"
        if text != self.text():
            self.setText(text)

    def _width_of(self, text: str) -> int:
        # As if all of it were bold: rather a little too wide.
        font = QtGui.QFont(self.font())
        font.setBold(True)
        return QtGui.QFontMetrics(font).horizontalAdvance(text) + 4
