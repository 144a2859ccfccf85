"""Actions, menus and the palette, made from the table of actions."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from pathlib import Path

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, QSize, Qt, Signal

from skinsource_gui.fields.number_field import end_typing
from skinsource_gui.qt.keys import shortcut_text
from skinsource_gui.qt.layouts import in_column
from skinsource_gui.shell.actions import MENUS, ActionSpec
from skinsource_gui.state.document import Document
from skinsource_gui.state.preferences import Preferences

#: Opens the first menu.
MENU_KEY = "F10"


def fill_menu_bar(
    bar: QtWidgets.QMenuBar,
    specs: Sequence[ActionSpec],
    actions: Mapping[str, QtGui.QAction],
    submenus: Mapping[str, QtWidgets.QMenu],
    panels: Iterable[QtGui.QAction],
) -> None:
    """Fill ``bar``.

    Parameters
    ----------
    bar
        To be filled.
    specs, actions
        The table, and the action of each of its entries; some have no menu.
    submenus
        Menus that stand after the action of that name.
    panels
        Actions that show and hide panels.
    """
    # A letter of its own for each: Alt and the letter open it, F10 the first.
    menus = {title: bar.addMenu(f"&{title}") for title in MENUS}
    within: dict[tuple[str, str], QtWidgets.QMenu] = {}
    for spec in specs:
        if not spec.menu:
            continue
        menu = menus[spec.menu]
        if spec.separated:
            menu.addSeparator()
        if spec.submenu:
            path = spec.menu, spec.submenu
            if path not in within:
                within[path] = menu.addMenu(spec.submenu)
            menu = within[path]
        menu.addAction(actions[spec.name])
        menu.setToolTipsVisible(menu.toolTipsVisible() or bool(spec.missing))
        if spec.name in submenus:
            menu.addMenu(submenus[spec.name])
    # It stands where snapshots are stored, too.
    within["Edit", "Snapshots"].insertAction(
        actions["take_snapshot"], actions["compare_side_by_side"]
    )
    shown = menus["View"].addMenu("Panels")
    for action in panels:
        shown.addAction(action)
    first = QtGui.QShortcut(QtGui.QKeySequence(MENU_KEY), bar)
    first.activated.connect(lambda: bar.setActiveAction(menus["File"].menuAction()))


class RecentMenu(QtWidgets.QMenu):
    """Lists the recent files, newest first, each time it is shown."""

    #: The path of the file that was chosen.
    chosen = Signal(object)

    def __init__(self, preferences: Preferences, parent: QtWidgets.QWidget) -> None:
        super().__init__("Open recent", parent)
        self.setObjectName("open_recent")
        self.setToolTipsVisible(True)
        self._preferences = preferences
        self.aboutToShow.connect(self._fill)
        self.triggered.connect(self._choose)

    def _fill(self) -> None:
        self.clear()
        for path in map(Path, self._preferences.recent_names):
            entry = self.addAction(path.name)
            entry.setToolTip(str(path))
            entry.setData(str(path))
        if self.isEmpty():
            self.addAction("Nothing opened or saved yet").setEnabled(False)

    def _choose(self, entry: QtGui.QAction) -> None:
        if entry.data():
            self.chosen.emit(Path(entry.data()))


# Above and below each name.
_AROUND_PX = 14
_LIST_KEYS = (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_PageUp, Qt.Key.Key_PageDown)
NOTHING_FOUND = "Nothing found"
_HINT = "Try another word, such as export, limb, mute or theme"
#: Properties of an action: keywords by which it is found, and why it cannot be done now.
KEYWORDS, MISSING = "keywords", "missing"


class SearchLine(QtWidgets.QLineEdit):
    """A line to type in; keys for lists move in what it searches while it has the keyboard."""

    def __init__(self, name: str, searched: QtWidgets.QWidget) -> None:
        super().__init__()
        self._searched = searched
        self.setPlaceholderText("Type a few letters…")
        self.setAccessibleName(name)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() in _LIST_KEYS:
            QtWidgets.QApplication.sendEvent(self._searched, event)
        else:
            super().keyPressEvent(event)


class Palette(QtWidgets.QDialog):
    """A list of actions that narrows while one types; Enter runs the marked one.

    What cannot be done now comes last, grey and with the reason.

    Parameters
    ----------
    actions
        What can be found; those without a parent are kept as long as the palette.
    """

    def __init__(self, actions: Sequence[QtGui.QAction], parent: QtWidgets.QWidget | None = None):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle("Search actions")
        self.setObjectName("palette")
        self.resize(640, 400)
        self._actions = actions
        for action in actions:
            if action.parent() is None:
                action.setParent(self)
        self.list = QtWidgets.QTreeWidget()
        self.line = SearchLine("Search actions", self.list)
        self.list.setColumnCount(2)
        self.list.setHeaderHidden(True)
        self.list.setRootIsDecorated(False)
        self.list.setAccessibleName("Matching actions")
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        # A long name is elided; keys never are.
        columns = self.list.header()
        columns.setStretchLastSection(False)
        columns.setSectionResizeMode(0, QtWidgets.QHeaderView.ResizeMode.Stretch)
        columns.setSectionResizeMode(1, QtWidgets.QHeaderView.ResizeMode.ResizeToContents)
        in_column(self.line, self.list, of=self)
        self.line.textChanged.connect(self._narrow)
        self.line.returnPressed.connect(self._run)
        self.list.itemActivated.connect(self._run)
        self.list.itemClicked.connect(self._run)
        self._narrow("")

    def _narrow(self, letters: str) -> None:
        self.list.clear()
        found = [each for each in self._actions if each.isEnabled() or each.property(MISSING)]
        for action in sorted(matching(found, letters), key=lambda each: not each.isEnabled()):
            self._add(_label(action), _state_and_keys(action), action)
        if not self.list.topLevelItemCount():
            for text in (NOTHING_FOUND, _HINT, f"{shortcut_text('show_keys')} shows all keys"):
                self._add(text)
        elif (first := self.list.topLevelItem(0)) is not None:
            self.list.setCurrentItem(first)

    def _add(
        self, name: str, keys: str = "", action: QtGui.QAction | None = None
    ) -> QtWidgets.QTreeWidgetItem:
        row = QtWidgets.QTreeWidgetItem(self.list, [name, keys])
        row.setSizeHint(0, QSize(0, self.fontMetrics().height() + _AROUND_PX))
        row.setTextAlignment(1, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        row.setForeground(1, self.palette().placeholderText())
        row.setData(0, Qt.ItemDataRole.UserRole, action)
        row.setToolTip(0, "" if action is None else action.toolTip())
        row.setDisabled(action is None or not action.isEnabled())
        return row

    def _run(self, clicked: QtWidgets.QTreeWidgetItem | None = None) -> None:
        item = self.list.currentItem() if clicked is None else clicked
        action = None if item is None else item.data(0, Qt.ItemDataRole.UserRole)
        if action is not None and action.isEnabled():
            # The action may handle events: the line that has the key is deleted after it returns.
            self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose, False)
            self.accept()
            action.trigger()
            self.deleteLater()


def _state_and_keys(action: QtGui.QAction) -> str:
    """Return whether an action is on, and its keys; or why it cannot be done."""
    if not action.isEnabled():
        return str(action.property(MISSING))
    state = "on   " if action.isChecked() else ""
    keys = action.shortcut().toString(QtGui.QKeySequence.SequenceFormat.NativeText)
    # That of a panel, which its menu has after its name.
    return state + str(keys or action.text().partition("\t")[2])


def matching(actions: Sequence[QtGui.QAction], letters: str) -> list[QtGui.QAction]:
    """Return the actions that are meant by ``letters``, the likeliest first.

    First come those that say the letters in one piece: as their whole name, at its beginning, at
    the beginning of a word, elsewhere.  Then come those that have a keyword which begins with them.
    """
    typed = letters.strip().lower()
    by_name = [action for action in actions if typed in _label(action).lower()]
    by_keyword = [
        action for action in actions if action not in by_name and _is_keyword(action, typed)
    ]
    return [*sorted(by_name, key=lambda action: _nearness(action, typed)), *by_keyword]


def _label(action: QtGui.QAction) -> str:
    """Return the name of an action without the key that a menu has after it."""
    return action.text().partition("\t")[0]


def _nearness(action: QtGui.QAction, typed: str) -> tuple[int, int]:
    """Return the distance of the name of an action from what is typed."""
    text = _label(action).lower().rstrip("…")
    # "Show panel: Library" is called "Library" by who looks for it.
    name = text.rpartition(": ")[2]
    position = text.find(typed)
    if typed in (text, name):
        return 0, position
    if text.startswith(typed) or name.startswith(typed):
        return 1, position
    return (2 if text[position - 1] in " (" else 3), position


def _is_keyword(action: QtGui.QAction, typed: str) -> bool:
    return f" {typed}" in f" {action.property(KEYWORDS) or ''}"


Capabilities = Mapping[str, QObject]


class ActionSet(QObject):
    """One `QAction` for each entry of the table, enabled while it can be done.

    Parameters
    ----------
    specs
        The table.
    document
        Its design and view are given to conditions and edits.
    capabilities
        The objects that carry out commands, by name.
    window
        Where the shortcuts work; also the parent.
    """

    #: An edit that an action makes.
    edited = Signal(object)

    def __init__(
        self,
        specs: Sequence[ActionSpec],
        document: Document,
        capabilities: Capabilities,
        window: QtWidgets.QWidget,
    ) -> None:
        super().__init__(window)
        self._specs, self._document = specs, document
        asked = {condition for spec in specs for condition in (spec.enabled, spec.checked)}
        self._conditions = tuple(condition for condition in asked if condition is not None)
        self.by_name = {spec.name: self._action(spec, capabilities, window) for spec in specs}
        for name in sorted({spec.group for spec in specs if spec.group}):
            group = QtGui.QActionGroup(self)
            for spec in specs:
                if spec.group == name:
                    group.addAction(self.by_name[spec.name])
        self._follow_steps(document.undo_stack)
        document.changed.connect(self.show_state)
        self.show_state()

    def __getitem__(self, name: str) -> QtGui.QAction:
        return self.by_name[name]

    def show_state(self) -> None:
        """Enable what can be done now, and show which switches are on."""
        design, view = self._document.design, self._document.view
        holds = {condition: condition(design, view) for condition in self._conditions}
        for spec in self._specs:
            action = self.by_name[spec.name]
            if spec.enabled is not None and action.isEnabled() != holds[spec.enabled]:
                action.setEnabled(holds[spec.enabled])
                _explain(action, spec)
            if spec.checked is not None:
                action.setChecked(holds[spec.checked])
            if spec.of_clips:
                action.setText(spec.of_clips if view.selected_clips else spec.text)

    def _action(
        self, spec: ActionSpec, capabilities: Capabilities, window: QtWidgets.QWidget
    ) -> QtGui.QAction:
        # A menu shows the text after a tab in its column of keys.
        key_column = f"\t{spec.key_elsewhere}" if spec.key_elsewhere else ""
        action = QtGui.QAction(f"{spec.text}{key_column}", window)
        action.setObjectName(spec.name)
        if spec.short:
            action.setIconText(spec.short)
        action.setShortcuts([QtGui.QKeySequence(key) for key in spec.keys])
        _explain(action, spec)
        if spec.group != "workspace":
            # Their buttons stay below the mouse, and what happened is told meanwhile.
            action.setStatusTip(spec.hint)
        action.setProperty(KEYWORDS, spec.keywords)
        action.setCheckable(spec.checked is not None or bool(spec.group))
        # A key comes before Enter.
        action.triggered.connect(lambda: end_typing())
        if spec.edit is not None:
            action.triggered.connect(partial(self._edit, spec))
        else:
            capability, _, method = spec.command.partition(".")
            command = getattr(capabilities[capability], method)
            arguments = (spec.argument,) if spec.argument else ()
            action.triggered.connect(partial(_run, command, arguments))
        return action

    def _edit(self, spec: ActionSpec, _checked: bool = False) -> None:
        document = self._document
        if spec.edit is not None:
            self.edited.emit(spec.edit(document.design, document.view))
        # A switch whose edit was refused goes back.
        self.show_state()

    def _follow_steps(self, steps: QtGui.QUndoStack) -> None:
        for action, can_change, text_change in (
            (self.by_name["undo"], steps.canUndoChanged, steps.undoTextChanged),
            (self.by_name["redo"], steps.canRedoChanged, steps.redoTextChanged),
        ):
            action.setEnabled(False)
            can_change.connect(action.setEnabled)
            text_change.connect(partial(_name_step, action))


def _explain(action: QtGui.QAction, spec: ActionSpec) -> None:
    """Say what an action does, and what is missing where it cannot be done."""
    missing = "" if action.isEnabled() else spec.missing
    action.setProperty(MISSING, missing)
    keys = action.shortcut().toString(QtGui.QKeySequence.SequenceFormat.NativeText)
    hint = f"{spec.hint} ({keys})" if keys else spec.hint
    action.setToolTip(f"{hint}\n{missing}" if missing else hint)


def _run(
    command: Callable[..., object], arguments: tuple[str, ...], _checked: bool = False
) -> None:
    command(*arguments)


def _name_step(action: QtGui.QAction, step: str) -> None:
    word = action.objectName().capitalize()
    action.setText(f"{word} {step[:1].lower()}{step[1:]}" if step else word)
    action.setIconText(word)
