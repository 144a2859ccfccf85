"""The one line above the panels: menus, steps, transport, workspaces, limb and search."""

import time
from collections.abc import Callable, Mapping, Sequence
from functools import partial

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, Qt

from skinsource.base.errors import printable
from skinsource.design import edits
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.labels import CHOICES, LIMBS, Word, limb_label, short_limb_title
from skinsource.limbs.dataset.store import NOT_INSTALLED
from skinsource.limbs.own_limbs import facts_of, missing_limb, own_limb_names
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.pages.dataset import TITLE
from skinsource_gui.qt.buttons import menu_of
from skinsource_gui.qt.layouts import Policy, in_row, named, show_tooltip, tooltip
from skinsource_gui.qt.theme import UNIT_PX, icon_of
from skinsource_gui.shell.menus import MISSING
from skinsource_gui.state.document import MOST_STEPS, Document, ReplaceDesign

#: Height of the line in letters of the usual size.
_HEAD_PX = 36
#: Where the list keeps what can be done with an entry; None: all that is usual.
_FLAGS = Qt.ItemDataRole.UserRole - 1
_ENABLED = Qt.ItemFlag.ItemIsEnabled
# Room for so many letters of a choice, and its width where there is little.
_LETTERS, _LEAST_PX = 9, 40


class LimbField(ChoiceField):
    """Chooses the limb; closed, it shows its short title."""

    @property
    def shown_text(self) -> str:
        return short_limb_title(self.value) if self.currentIndex() >= 0 else super().shown_text


class SetupBar(QtWidgets.QWidget):
    """Choices for what the whole window shows."""

    def __init__(self, document: Document) -> None:
        super().__init__()
        self._document = document
        self._limb_options: tuple[Word, ...] = LIMBS
        _, label, sentence, options = CHOICES[0]
        self._limb = named(LimbField(_spec(label, sentence, options)), "limb")
        self._limb.setMinimumContentsLength(_LETTERS)
        self._limb.setMinimumWidth(_LEAST_PX)
        self._limb.setSizePolicy(Policy.Maximum, Policy.Fixed)
        _explain(self._limb, options)
        in_row(self._limb, of=self, margins=0)
        self._limb.edited.connect(partial(self._choose, edits.change_limb))

    def show_state(self) -> None:
        """Take over the present design."""
        design = self._document.design
        self._limb.set_value(design.limb)
        facts = facts_of(design.limb)
        about = missing_limb(design.limb, "") if facts.missing else facts.sentence
        show_tooltip(self._limb, tooltip("Limb", about))

    def show_available(self, limbs: tuple[str, ...]) -> None:
        """Offer these limbs, and no others."""
        options = (*LIMBS, *(limb_label(name) for name in own_limb_names()))
        names = tuple(word.name for word in options)
        if options != self._limb_options:
            self._limb_options = options
            self._limb.set_spec(_spec("Limb", "", options))
            _explain(self._limb, options)
        for index, name in enumerate(names):
            there = name in limbs
            # Not by the item of the model: its Python wrapper outlives it, and PySide then takes
            # another object at the same address for that item.
            self._limb.setItemData(index, None if there else 0, _FLAGS)
            if name.startswith("measured-"):
                hint = "" if there else f"{NOT_INSTALLED} Help > {TITLE}… installs them."
                self._limb.setItemData(index, hint, Qt.ItemDataRole.ToolTipRole)

    def choices(self) -> list[QtGui.QAction]:
        """Return a new action for each choice, also those of the measure line."""
        actions, field = [], self._limb
        for index in range(field.count()):
            title = f"{field.accessibleName()}: {field.itemText(index)}"
            there = bool(field.model().flags(field.model().index(index, 0)) & _ENABLED)
            hint = field.itemData(index, Qt.ItemDataRole.ToolTipRole) or ""
            choose = partial(field.choose, field.itemData(index))
            actions.append(choice_action(title, hint, choose, "" if there else NOT_INSTALLED))
        measured = set(facts_of(self._document.design.limb).axes)
        single = len(self._document.view.axes) == 1
        for edit, (name, label, _, words) in zip(_LOOKS, CHOICES[2:], strict=True):
            for word in words:
                missing = "Choose two axes or more" * (name == "method" and single)
                if name == "axes" and not set(word.name) <= measured:
                    missing = "Not measured on this limb"
                choose = partial(self._choose, edit, word.name, None)
                title = f"{label}: {word.title}"
                hint = tooltip(word.sentence)
                actions.append(choice_action(title, hint, choose, missing))
        return actions

    def _choose(self, edit: Callable[..., Edit | Refusal], value: str, gesture: int | None) -> None:
        self._document.apply(edit(self._document.design, self._document.view, value), gesture)
        # After a refusal the field shows the limb of the design again.
        self.show_state()


#: Edits of what is looked at: axes, method, levels.
_LOOKS = (edits.look_along, edits.look_by_method, edits.level_over)


def choice_action(
    title: str, hint: str, choose: Callable[[], object], missing: str = ""
) -> QtGui.QAction:
    """Return an action of the palette that makes a choice, unless something is missing for it."""
    action = QtGui.QAction(title)
    action.setToolTip(hint)
    action.setEnabled(not missing)
    action.setProperty(MISSING, missing)
    action.triggered.connect(lambda: choose())
    return action


def _spec(label: str, sentence: str, words: tuple[Word, ...]) -> ChoiceSpec:
    options = tuple((word.name, word.title) for word in words)
    return ChoiceSpec(label=label, options=options, hint=sentence)


def _explain(field: QtWidgets.QComboBox, options: tuple[Word, ...]) -> None:
    """Set a tooltip on what each entry means."""
    for index, word in enumerate(options):
        field.setItemData(index, tooltip(word.sentence), Qt.ItemDataRole.ToolTipRole)


_Event = QEvent.Type
_REFITTED = (_Event.LayoutRequest, _Event.Resize, _Event.FontChange, _Event.StyleChange)
_Style = Qt.ToolButtonStyle


class WorkspaceButtons(QtWidgets.QWidget):
    """Buttons beside each other, one for each workspace; where there is no room, a menu of them.

    The last one has a button only once it is offered, or shown.
    """

    def __init__(self, actions: Sequence[QtGui.QAction]) -> None:
        super().__init__()
        self.setObjectName("workspaces")
        self._buttons = [_button(action, _Style.ToolButtonTextOnly) for action in actions]
        self._last, self._folded, self._offered = actions[-1], False, False
        self._menu = named(QtWidgets.QToolButton(), "workspace_menu")
        menu_of(self._menu).addActions(list(actions))
        in_row(*self._buttons, self._menu, of=self, margins=0, gap_px=2)
        for action in actions:
            action.toggled.connect(self._name)
        self._name()

    @property
    def whole_px(self) -> int:
        """Width of all buttons."""
        return sum(button.sizeHint().width() + 2 for button in self._offers)

    @property
    def folded_px(self) -> int:
        """Width of the menu."""
        return self._menu.sizeHint().width()

    def fold(self, folded: bool) -> None:
        """Show the menu, or all buttons."""
        self._folded, shown = folded, self._offers
        for button in self._buttons:
            button.setHidden(folded or button not in shown)
        self._menu.setVisible(folded)

    def offer_last(self, offered: bool) -> None:
        """Show the button of the last workspace from now on, or only while that is shown."""
        self._offered = offered
        self.fold(self._folded)

    @property
    def _offers(self) -> list[QtWidgets.QToolButton]:
        return self._buttons[: None if self._offered or self._last.isChecked() else -1]

    def _name(self) -> None:
        self.fold(self._folded)
        chosen = [button.text() for button in self._buttons if button.isChecked()]
        self._menu.setText("".join(chosen))
        self._menu.setAccessibleName(f"Workspace: {''.join(chosen)}")


class StepsMenu(QtWidgets.QMenu):
    """Lists what was done, the newest first, with its time; what is chosen is gone back to.

    Parameters
    ----------
    document
        Whose steps.
    parent
        As in Qt.
    """

    def __init__(self, document: Document, parent: QtWidgets.QWidget) -> None:
        super().__init__("History", parent)
        self.setObjectName("steps")
        self._document = document
        self.aboutToShow.connect(self._fill)
        self.triggered.connect(lambda step: document.go_to(step.data()))

    def _fill(self) -> None:
        self.clear()
        stack = self._document.undo_stack
        for count in range(stack.count(), 0, -1):
            step = stack.command(count - 1)
            at_s = step.at_s if isinstance(step, ReplaceDesign) else 0.0
            self._add(count, step.text(), time.strftime("%H:%M:%S", time.localtime(at_s)))
        self._add(0, self._start())

    def _add(self, count: int, label: str, when: str = "") -> None:
        stack = self._document.undo_stack
        saved = "saved" if count == stack.cleanIndex() and self._document.path else ""
        when = ", ".join(filter(None, (when, saved)))
        step = self.addAction(f"{label.replace('&', '&&')}\t{when}")
        step.setData(count)
        step.setCheckable(True)
        step.setChecked(count == stack.index())
        if step.isChecked():
            self.setActiveAction(step)

    def _start(self) -> str:
        document = self._document
        if document.undo_stack.count() >= MOST_STEPS:
            return f"Before the last {MOST_STEPS} steps"
        if document.opened:
            return f"Opened {document.opened.name}"
        if document.recovered:
            return "Recovered work"
        return f"Scene: {printable(document.scene)}" if document.scene else "New design"


class HeadLine(QtWidgets.QWidget):
    """The one line above the panels: menus, steps, transport, workspaces, limb and search.

    Parameters
    ----------
    menus, transport, choices
        What stands in it, from left to right.
    actions
        By name, those of its buttons.
    steps
        The list under the undo arrow.
    workspaces
        Actions of the workspaces.

    Attributes
    ----------
    workspaces
        Their buttons.
    """

    def __init__(
        self,
        menus: QtWidgets.QMenuBar,
        actions: Mapping[str, QtGui.QAction],
        steps: StepsMenu,
        transport: QtWidgets.QWidget,
        workspaces: Sequence[QtGui.QAction],
        choices: SetupBar,
    ) -> None:
        super().__init__()
        self.setObjectName("head_line")
        # On some desktops the menus would leave the window.
        menus.setNativeMenuBar(False)
        for more in menus.findChildren(QtWidgets.QToolButton):
            more.setIcon(QtGui.QIcon())
            more.setText("»")
        menus.setSizePolicy(Policy.Maximum, Policy.Minimum)
        self._icons = {
            actions["undo"]: "undo",
            actions["redo"]: "redo",
            actions["find_action"]: "search",
        }
        undo, redo, self._search = (
            _button(action, _Style.ToolButtonIconOnly) for action in self._icons
        )
        undo.setMenu(steps)
        undo.setPopupMode(QtWidgets.QToolButton.ToolButtonPopupMode.MenuButtonPopup)
        self._menus, self._choices = menus, choices
        self.workspaces = WorkspaceButtons(workspaces)
        self._steady = transport, undo, redo
        in_row(
            *(menus, _line(), undo, redo, _line(), transport, None, self.workspaces),
            *(None, choices, self._search),
            of=self,
            margins=(0, 2, UNIT_PX // 2, 2),
            gap_px=UNIT_PX // 2,
        )
        self.setMinimumHeight(_HEAD_PX)
        self._draw()

    def event(self, event: QEvent) -> bool:
        if event.type() in _REFITTED:
            self._fit()
        elif event.type() == _Event.PaletteChange:
            self._draw()
        return super().event(event)

    def _draw(self) -> None:
        for action, icon in self._icons.items():
            action.setIcon(icon_of(icon))
            action.setIconVisibleInMenu(False)

    def _fit(self) -> None:
        """Name the search, show all workspaces, then choices and menus, as there is room."""
        row = self.layout()
        if row is None:
            return
        menus, choices = self._menus.sizeHint().width(), self._choices.sizeHint().width()
        rest = sum(part.sizeHint().width() for part in self._steady)
        rest += self._steady[-1].sizeHint().width() + (row.count() - 1) * row.spacing()
        whole = rest + menus + choices + self.workspaces.whole_px
        name_px = self.fontMetrics().horizontalAdvance(self._search.text()) + 2 * UNIT_PX
        named = whole + name_px <= self.width()
        self._search.setToolButtonStyle(
            _Style.ToolButtonTextBesideIcon if named else _Style.ToolButtonIconOnly
        )
        self.workspaces.fold(whole > self.width())
        # One menu stays in any case; in letters three times as large on a small screen the
        # palette has the choices.
        room = self.width() - rest - self.workspaces.folded_px
        least = self.fontMetrics().horizontalAdvance("File") + 5 * UNIT_PX
        kept = self._choices.minimumSizeHint().width()
        self._choices.setHidden(room < least + kept)
        self._menus.setMinimumWidth(max(least, min(menus, room - kept)))


def _button(action: QtGui.QAction, style: Qt.ToolButtonStyle) -> QtWidgets.QToolButton:
    """Return a button of an action that the keyboard reaches by its key and its menu."""
    button = named(QtWidgets.QToolButton(), f"{action.objectName()}_button")
    button.setDefaultAction(action)
    button.setToolButtonStyle(style)
    button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    return button


def _line() -> QtWidgets.QFrame:
    line = named(QtWidgets.QFrame(), "bar_line")
    line.setFixedWidth(1)
    return line
