"""A snapshot as a card, and its texts."""

from collections.abc import Sequence
from functools import partial

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QPoint, QSize, Qt, Signal

from skinsource.design.comparing import gain_text, loudest_db, snapshot_name
from skinsource.design.design import TITLE
from skinsource.design.labels import short_limb_title
from skinsource_gui.fields.editors import TextLine
from skinsource_gui.fields.units import minus
from skinsource_gui.qt.buttons import passing_menu
from skinsource_gui.qt.keys import claims_shortcut, meaning_of, shortcut_text
from skinsource_gui.qt.layouts import named
from skinsource_gui.qt.theme import UNIT_PX, tabular
from skinsource_gui.state.compared import Compared, gain_db, is_silent


def card_level_text(compared: Compared) -> str:
    """Return the level of the loudest output as it is shown, "−12.3 dB"; "…": not known yet."""
    if compared.values is None:
        return "–" if compared.problem else "…"
    stored = loudest_db(compared.values["output_levels_db"])
    return "silent" if is_silent(compared) else minus(f"{stored + gain_db(compared):z.1f} dB")


def card_text(compared: Compared, on_limb: str, *, present: bool) -> str:
    """Return all that a card shows, as it is read aloud."""
    gain = gain_text(compared.gain)
    parts = [
        f"{snapshot_name(compared.snapshot.number).capitalize()}{on_limb}",
        compared.title,
        f"loudest output {card_level_text(compared)}",
        f"shown {gain} to match" if gain else "",
        "in the window" if present else "",
        compared.problem,
        compared.left_out,
    ]
    return ", ".join(part for part in parts if part)


def told_titles(compared: Sequence[Compared]) -> dict[int, str]:
    """Return titles by number, without that of designs which several have: it tells none."""
    known = [side.title for side in compared]
    told = [side for side in compared if side.snapshot.title or known.count(side.title) == 1]
    return {side.snapshot.number: side.title for side in told}


def told_limbs(compared: Sequence[Compared]) -> dict[int, str]:
    """Return on which limb each is by number, " on Synthetic 1"; "" where that is one for all."""
    limbs = {side.snapshot.number: side.snapshot.design.limb for side in compared}
    several = len(set(limbs.values())) > 1
    return {number: f" on {short_limb_title(limb)}" * several for number, limb in limbs.items()}


_PLACE = "snapshot"
# Of the title on a card, and of the line in which it is typed.
_TITLE_PX, _LINE_PX = 96, 224


class Card(QtWidgets.QToolButton):
    """A snapshot as a card: a click shows it in the window, an empty card stores.

    Parameters
    ----------
    number
        Number of the snapshot; 0: the edited design.

    Attributes
    ----------
    compared
        The snapshot; None: nothing is stored.
    present
        Whether the snapshot is in the window.
    """

    #: What to do with this number: ``"show"``, ``"store"`` or ``"forget"``.
    requested = Signal(int, str)
    #: This number, and the title that was typed for it.
    renamed = Signal(int, str)

    def __init__(self, number: int, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self.number = number
        # The design that is edited is never stored, and without it its card is away.
        self._store_key = shortcut_text(f"store_snapshot_{number}") if number else ""
        self.compared: Compared | None = None
        self.present = False
        self.setObjectName(f"snapshot_card_{number}")
        self.setCheckable(True)
        self.setFont(tabular(self.font()))
        self.setStyleSheet("padding: 2px;")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.customContextMenuRequested.connect(self._open_menu)
        self.clicked.connect(self._act)
        self.show_snapshot(None, present=False)

    def show_snapshot(
        self, compared: Compared | None, title: str = "", on_limb: str = "", *, present: bool
    ) -> None:
        """Take over what to show, how it is called and on which limb; None: nothing is stored."""
        self.compared, self.present = compared, present
        text = (
            f"Snapshot {self.number}: nothing stored; click, or press {self._store_key}, to store"
            if compared is None
            else card_text(compared, on_limb, present=present)
        )
        self.setAccessibleName(text)
        self.setToolTip(text)
        self.setChecked(present)
        if compared is None:
            self.setText(f"{self.number}: {self._store_key}")
        else:
            warned = "⚠ " if compared.left_out else ""
            # Behind the last middle dot titles of scenes differ.
            own, right = title.rpartition(" · ")[2], Qt.TextElideMode.ElideRight
            called = f"{compared.name} {self.fontMetrics().elidedText(own, right, _TITLE_PX)}"
            self.setText(f"{warned}{called.strip()}: {card_level_text(compared)}")

    def sizeHint(self) -> QSize:
        # Levels that change move nothing.
        widest = f"{self.text().rpartition(':')[0]}: −88.8 dB"
        width = self.fontMetrics().horizontalAdvance(widest) + UNIT_PX
        return super().sizeHint().expandedTo(QSize(width, 0))

    def nextCheckState(self) -> None:
        """Leave it checked while it is in the window, whatever is clicked."""

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, partial(meaning_of, _PLACE)) or super().event(event)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        means = meaning_of(_PLACE, event)
        if means == "forget" and self.compared is not None:
            self.requested.emit(self.number, "forget")
        elif means == "rename":
            self._rename()
        elif means == "act":
            self._act()
        else:
            super().keyPressEvent(event)

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:
        self._rename()  # the first click has shown it

    def _rename(self) -> None:
        # The working design has the title that stands in the inspector.
        if self.compared is not None and self.number:
            line = TitleLine(self, self.compared.title)
            line.edited.connect(lambda title, _: self.renamed.emit(self.number, title))

    def _act(self) -> None:
        self.requested.emit(self.number, "show" if self.compared else "store")

    def _open_menu(self, at: QPoint) -> None:
        menu = passing_menu(self)
        if self.compared is not None:
            menu.addAction("Show", lambda: self.requested.emit(self.number, "show"))
        if self.compared is not None and self.number:
            menu.addAction("Rename", self._rename)
        if self.number:
            menu.addAction(
                "Store current design", lambda: self.requested.emit(self.number, "store")
            )
        if self.compared is not None and not (self.present and not self.number):
            menu.addAction("Remove", lambda: self.requested.emit(self.number, "forget"))
        menu.popup(self.mapToGlobal(at))


class TitleLine(TextLine):
    """Edits the title of a snapshot over its card, until it loses the keyboard."""

    def __init__(self, card: Card, title: str) -> None:
        window = card.window()
        super().__init__(TITLE, window)
        named(self, "snapshot_title", "Title of the snapshot")
        self._card = card
        self.set_value(title)
        at, width = card.mapTo(window, QPoint()), max(card.width(), _LINE_PX)
        self.setGeometry(min(at.x(), window.width() - width), at.y(), width, card.height())
        self.selectAll()
        self.show()
        self.setFocus(Qt.FocusReason.OtherFocusReason)

    def focusOutEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusOutEvent(event)
        if event.reason() != Qt.FocusReason.PopupFocusReason:
            self.hide()
            self.deleteLater()

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        super().keyPressEvent(event)
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Escape):
            event.accept()
            self._card.setFocus(Qt.FocusReason.OtherFocusReason)
