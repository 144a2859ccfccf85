"""The actions of a window, made from the table of actions."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QAction, QActionGroup, QKeySequence, QUndoStack
from PySide6.QtWidgets import QWidget

from skinsource_gui.shell.action_spec import ActionSpec
from skinsource_gui.shell.palette import KEYWORDS
from skinsource_gui.state.document import Document

Capabilities = Mapping[str, QObject]


class ActionSet(QObject):
    """One `QAction` for each entry of the table, enabled while it can be done.

    Parameters
    ----------
    specs
        The table.
    document
        What the conditions look at, and what edits change.
    capabilities
        Who carries out commands, by name.
    window
        Where the shortcuts work; also the parent.
    """

    #: An edit that an action asks for.
    edited = Signal(object)

    def __init__(
        self,
        specs: Sequence[ActionSpec],
        document: Document,
        capabilities: Capabilities,
        window: QWidget,
    ) -> None:
        super().__init__(window)
        self._specs, self._document = specs, document
        self.by_name = {spec.name: self._action(spec, capabilities, window) for spec in specs}
        for name in sorted({spec.group for spec in specs if spec.group}):
            group = QActionGroup(self)
            for spec in specs:
                if spec.group == name:
                    group.addAction(self.by_name[spec.name])
        self._follow_steps(document.undo_stack)
        document.changed.connect(self.show_state)
        self.show_state()

    def __getitem__(self, name: str) -> QAction:
        return self.by_name[name]

    def show_state(self) -> None:
        """Enable what can be done now, and show which switches are on."""
        design, view = self._document.design, self._document.view
        for spec in self._specs:
            if spec.enabled is not None:
                self.by_name[spec.name].setEnabled(spec.enabled(design, view))
            if spec.checked is not None:
                self.by_name[spec.name].setChecked(spec.checked(design, view))

    def _action(self, spec: ActionSpec, capabilities: Capabilities, window: QWidget) -> QAction:
        # What follows a tab, a menu shows in its column of keys, and nothing is done by it.
        beside = f"\t{spec.key_elsewhere}" if spec.key_elsewhere else ""
        action = QAction(f"{spec.text}{beside}", window)
        action.setObjectName(spec.name)
        if spec.short:
            action.setIconText(spec.short)
        action.setShortcuts([QKeySequence(key) for key in spec.keys])
        keys = action.shortcut().toString(QKeySequence.SequenceFormat.NativeText)
        action.setToolTip(f"{spec.hint} ({keys})" if keys else spec.hint)
        action.setStatusTip(spec.hint)
        action.setProperty(KEYWORDS, spec.keywords)
        action.setCheckable(spec.checked is not None or bool(spec.group))
        if spec.edit is not None:
            action.triggered.connect(partial(self._edit, spec))
        else:
            capability, _, method = spec.command.partition(".")
            command = getattr(capabilities[capability], method)
            words = (spec.argument,) if spec.argument else ()
            action.triggered.connect(partial(_run, command, words))
        return action

    def _edit(self, spec: ActionSpec, _checked: bool = False) -> None:
        document = self._document
        if spec.edit is not None:
            self.edited.emit(spec.edit(document.design, document.view))
        # A switch whose edit was refused is what it was.
        self.show_state()

    def _follow_steps(self, steps: QUndoStack) -> None:
        for action, can_change, text_change in (
            (self.by_name["undo"], steps.canUndoChanged, steps.undoTextChanged),
            (self.by_name["redo"], steps.canRedoChanged, steps.redoTextChanged),
        ):
            action.setEnabled(False)
            can_change.connect(action.setEnabled)
            text_change.connect(partial(_name_step, action))


def _run(command: Callable[..., object], words: tuple[str, ...], _checked: bool = False) -> None:
    command(*words)


def _name_step(action: QAction, step: str) -> None:
    word = action.objectName().capitalize()
    action.setText(f"{word} {step[:1].lower()}{step[1:]}" if step else word)
    action.setIconText(word)
