"""Finds any action by a few letters of its name."""

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QModelIndex, QObject, QPersistentModelIndex, QSize, Qt
from PySide6.QtGui import QAction, QKeyEvent, QKeySequence, QPainter, QPalette
from PySide6.QtWidgets import (
    QDialog,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QVBoxLayout,
    QWidget,
)

from skinsource_gui.widgets.keys import shortcut_text

# Right of the keys, and at least so much between them and the name.
_EDGE_PX, _GAP_PX = 8, 16
_NOTHING_FOUND = "Nothing found"
_HINT = "Try another word, such as export, limb, mute or theme"
#: Property of an action: other words by which it is found.
KEYWORDS = "keywords"
#: Property of an action that only explains: it is found after all others.
BESIDES = "besides"


class Palette(QDialog):
    """A list of actions that narrows while one types; Enter runs the marked one.

    Parameters
    ----------
    actions
        What can be found; those without a parent are kept as long as the palette.
    """

    def __init__(
        self,
        actions: Sequence[QAction],
        parent: QWidget | None = None,
    ):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle("Search actions")
        self.setObjectName("palette")
        self.resize(640, 400)
        self._actions = actions
        for action in actions:
            if action.parent() is None:
                action.setParent(self)
        self.line = QLineEdit()
        self.line.setPlaceholderText("Type a few letters…")
        self.line.setAccessibleName("Search actions")
        self.list = QListWidget()
        self.list.setAccessibleName("Matching actions")
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.list.setItemDelegate(_KeysAtTheRight(self.list))
        # A long name is elided; keys never are.
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        layout = QVBoxLayout(self)
        layout.addWidget(self.line)
        layout.addWidget(self.list)
        self.line.textChanged.connect(self._narrow)
        self.line.returnPressed.connect(self._run)
        self.line.installEventFilter(self)
        self.list.itemActivated.connect(self._run)
        self.list.itemClicked.connect(self._run)
        self._narrow("")

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        # Up and Down move in the list while the line keeps the keyboard.
        if event.type() == QEvent.Type.KeyPress and isinstance(event, QKeyEvent):
            step = {Qt.Key.Key_Down: 1, Qt.Key.Key_Up: -1}.get(Qt.Key(event.key()))
            if step:
                row = self.list.currentRow() + step
                self.list.setCurrentRow(max(0, min(self.list.count() - 1, row)))
                return True
        return super().eventFilter(watched, event)

    def _narrow(self, letters: str) -> None:
        self.list.clear()
        for action in matching([one for one in self._actions if one.isEnabled()], letters):
            item = QListWidgetItem(_words(action))
            item.setToolTip(action.toolTip())
            item.setData(Qt.ItemDataRole.UserRole, action)
            self.list.addItem(item)
        if self.list.count():
            self.list.setCurrentRow(0)
        else:
            self._say_nothing_found()

    def _say_nothing_found(self) -> None:
        for words in (_NOTHING_FOUND, _HINT, f"{shortcut_text('show_keys')} shows all keys"):
            item = QListWidgetItem(words)
            item.setFlags(Qt.ItemFlag.NoItemFlags)
            self.list.addItem(item)

    def _run(self) -> None:
        item = self.list.currentItem()
        action = None if item is None else item.data(Qt.ItemDataRole.UserRole)
        if action is not None:
            # What is done may handle events: the line whose key this is stays until it returns.
            self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose, False)
            self.accept()
            action.trigger()
            self.deleteLater()


class _KeysAtTheRight(QStyledItemDelegate):
    """Draws an action with its shortcut at the right, and whether it is on."""

    def sizeHint(
        self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> QSize:
        return QSize(0, super().sizeHint(option, index).height() + 10)

    def initStyleOption(
        self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        super().initStyleOption(option, index)
        # Asked for its size it has no width yet.
        if option.rect.width() > 0:
            keys = option.fontMetrics.horizontalAdvance(_state_and_keys(index))
            room = option.rect.width() - keys - (_GAP_PX if keys else 0) - _EDGE_PX
            option.text = option.fontMetrics.elidedText(
                option.text, Qt.TextElideMode.ElideRight, room
            )

    def paint(
        self,
        painter: QPainter,
        option: QStyleOptionViewItem,
        index: QModelIndex | QPersistentModelIndex,
    ) -> None:
        super().paint(painter, option, index)
        words = _state_and_keys(index)
        chosen = option.state & QStyle.StateFlag.State_Selected
        role = QPalette.ColorRole.HighlightedText if chosen else QPalette.ColorRole.PlaceholderText
        painter.save()
        painter.setPen(option.palette.color(role))
        place = option.rect.adjusted(0, 0, -_EDGE_PX, 0)
        flags = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        painter.drawText(place, flags, words)
        painter.restore()


def _state_and_keys(index: QModelIndex | QPersistentModelIndex) -> str:
    """What stands at the right of an action; empty beside what is none."""
    action = index.data(Qt.ItemDataRole.UserRole)
    if action is None:
        return ""
    state = "on   " if action.isCheckable() and action.isChecked() else ""
    keys = action.shortcut().toString(QKeySequence.SequenceFormat.NativeText)
    # That of a panel, which its menu has after its name.
    return state + str(keys or action.text().partition("\t")[2])


def matching(actions: Sequence[QAction], letters: str) -> list[QAction]:
    """Return the actions that are meant by ``letters``, the likeliest first.

    First come those that say the letters in one piece: as their whole name, at its beginning, at
    the beginning of a word, elsewhere.  Then come those that have a keyword which begins with them;
    only where there is neither, those that say them scattered.  What only explains comes last.
    """
    typed = letters.strip().lower()
    besides = [one for one in actions if one.property(BESIDES) and typed in _words(one).lower()]
    actions = [one for one in actions if not one.property(BESIDES)]
    said = [one for one in actions if typed in _words(one).lower()]
    meant = [one for one in actions if one not in said and _is_keyword(one, typed)]
    if not (said or meant or besides):
        scores = ((one, score(letters, _words(one))) for one in actions)
        gaps = {one: gap for one, gap in scores if gap is not None}
        return sorted(gaps, key=lambda one: gaps[one])
    return [*sorted(said, key=lambda one: _nearness(one, typed)), *meant, *besides]


def _words(action: QAction) -> str:
    """What an action is called; its menu may have a key after that."""
    return action.text().partition("\t")[0]


def _nearness(action: QAction, typed: str) -> tuple[int, int]:
    """How near the name of an action is to what is typed; the least is the nearest."""
    text = _words(action).lower().rstrip("…")
    # "Show panel: Library" is called "Library" by who looks for it.
    name = text.rpartition(": ")[2]
    place = text.find(typed)
    if typed in (text, name):
        return 0, place
    if text.startswith(typed) or name.startswith(typed):
        return 1, place
    return (2 if text[place - 1] in " (" else 3), place


def _is_keyword(action: QAction, typed: str) -> bool:
    return any(word.startswith(typed) for word in str(action.property(KEYWORDS) or "").split())


def score(letters: str, text: str) -> int | None:
    """How far apart ``letters`` stand in ``text``, in this order; None where they do not."""
    place, gaps, lowered = -1, 0, text.lower()
    for letter in letters.lower().replace(" ", ""):
        found = lowered.find(letter, place + 1)
        if found < 0:
            return None
        gaps += found - place - 1
        place = found
    return gaps
