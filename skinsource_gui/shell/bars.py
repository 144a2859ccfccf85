"""The bar above the panels: limb, scaling, transport and a few actions."""

from collections.abc import Callable, Sequence
from functools import partial

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QObject, QSize, Qt, Signal

from skinsource.design import edits
from skinsource.design.design import Design
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.labels import CHOICES, LIMBS, Word, limb_label, scalings_on
from skinsource.design.view import View
from skinsource.limbs.dataset.store import NOT_INSTALLED
from skinsource.limbs.own_limbs import drive_unit_known, facts_of, own_limb_names
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.pages.dataset import TITLE
from skinsource_gui.qt.layouts import in_row
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.qt.tooltips import show_tooltip, tooltip

_LEAST_PX = 260
#: Where the list keeps what can be done with an entry; None: all that is usual.
_FLAGS = Qt.ItemDataRole.UserRole - 1
_ENABLED = Qt.ItemFlag.ItemIsEnabled


class SetupBar(QtWidgets.QWidget):
    """Choices for what the whole window shows."""

    #: `Edit` or `Refusal`, number of the gesture or None.
    edited = Signal(object, object)

    def __init__(self, parent: QtWidgets.QWidget | None = None):
        super().__init__(parent)
        self._design: Design | None = None
        self._view: View | None = None
        self._limb_options: tuple[Word, ...] = LIMBS
        self._drive_unit_known = True
        self._row = in_row(of=self, margins=0, gap_px=6)
        self._limb, self._scaling = (
            self._choice(label, sentence, options) for _, label, sentence, options in CHOICES[:2]
        )
        self._row.addStretch(1)
        self._titles = self.findChildren(QtWidgets.QLabel)
        self._limb.edited.connect(partial(self._choose, edits.change_limb))
        self._scaling.edited.connect(partial(self._choose, edits.change_scaling))

    def show_state(self, design: Design, view: View) -> None:
        """Take over the present design and view."""
        self._design, self._view = design, view
        self._limb.set_value(design.limb)
        self._scaling.set_value(design.scaling)
        self._explain_scalings(drive_unit_known(design.limb, design.limb_digest))

    def show_playhead(self, view: View) -> None:
        """Take over a view in which the playhead alone has moved."""
        self._view = view

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        # Where there is too little room, the labels are hidden rather than the choices.
        named = sum(title.sizeHint().width() + self._row.spacing() for title in self._titles)
        chosen = self._row.sizeHint().width()
        needed = chosen if self._titles[0].isVisibleTo(self) else chosen + named
        for title in self._titles:
            title.setVisible(self.width() >= needed)

    @property
    def wanted_px(self) -> int:
        """Width of all choices in full, without their labels."""
        fields = self.findChildren(ChoiceField)
        return sum(field.sizeHint().width() + 2 * self._row.spacing() for field in fields)

    def minimumSizeHint(self) -> QSize:
        return QSize(_LEAST_PX, super().minimumSizeHint().height())

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
            _set_enabled(self._limb, index, there=there)
            if name.startswith("measured-"):
                hint = "" if there else f"{NOT_INSTALLED} Help > {TITLE}… installs them."
                self._limb.setItemData(index, hint, Qt.ItemDataRole.ToolTipRole)

    def _explain_scalings(self, unit_known: bool) -> None:
        """Explain what amplitudes mean on the limb."""
        if unit_known == self._drive_unit_known:
            return
        self._drive_unit_known = unit_known
        _explain(self._scaling, scalings_on(drive_unit_known=unit_known))

    def choices(self, parent: QObject | None) -> list[QtGui.QAction]:
        """Return an action for each choice, also those of the measure line, owned by ``parent``."""
        actions = []
        for field in (self._limb, self._scaling):
            model = field.model()
            for index in range(field.count()):
                title = f"{field.accessibleName()}: {field.itemText(index)}"
                there = bool(model.flags(model.index(index, 0)) & _ENABLED)
                hint = field.itemData(index, Qt.ItemDataRole.ToolTipRole) or ""
                choose = partial(field.choose, field.itemData(index))
                actions.append(_action(title, hint, choose, parent, there=there))
        measured = set(facts_of(self._design.limb if self._design else "").axes)
        single = self._view is not None and len(self._view.axes) == 1
        for edit, (name, label, _, words) in zip(_LOOKS, CHOICES[2:], strict=True):
            for word in words:
                there = not (name == "method" and single)
                there = there and (name != "axes" or set(word.name) <= measured)
                choose = partial(self._choose, edit, word.name, None)
                title = f"{label}: {word.title}"
                actions.append(_action(title, tooltip(word.sentence), choose, parent, there=there))
        return actions

    def _choice(self, label: str, sentence: str, options: tuple[Word, ...]) -> ChoiceField:
        field = ChoiceField(_spec(label, sentence, options))
        field.setObjectName(label.lower())
        field.setSizeAdjustPolicy(QtWidgets.QComboBox.SizeAdjustPolicy.AdjustToContents)
        field.setSizePolicy(
            QtWidgets.QSizePolicy.Policy.Maximum, QtWidgets.QSizePolicy.Policy.Fixed
        )
        _explain(field, options)
        title = QtWidgets.QLabel(label)
        title.setBuddy(field)
        self._row.addWidget(title)
        self._row.addWidget(field)
        self._row.addSpacing(2)
        return field

    def _choose(self, edit: Callable[..., Edit | Refusal], value: str, gesture: int | None) -> None:
        if self._design and self._view:
            outcome = edit(self._design, self._view, value)
            self.edited.emit(outcome, gesture)
            if isinstance(outcome, Refusal):
                self.show_state(self._design, self._view)


#: Edits of what is looked at: axes, method, levels.
_LOOKS = (edits.look_along, edits.look_by_method, edits.level_over)


def _action(
    title: str, hint: str, choose: Callable[[], object], parent: QObject | None, *, there: bool
) -> QtGui.QAction:
    action = QtGui.QAction(title, parent)
    action.setToolTip(hint)
    action.setEnabled(there)
    action.triggered.connect(choose)
    return action


def _spec(label: str, sentence: str, words: tuple[Word, ...]) -> ChoiceSpec:
    options = tuple((word.name, word.title) for word in words)
    return ChoiceSpec(label=label, options=options, hint=sentence)


def _explain(field: QtWidgets.QComboBox, options: tuple[Word, ...]) -> None:
    """Set a tooltip on what each entry means."""
    for index, word in enumerate(options):
        field.setItemData(index, tooltip(word.sentence), Qt.ItemDataRole.ToolTipRole)


def _set_enabled(field: QtWidgets.QComboBox, index: int, *, there: bool) -> None:
    """Let an entry be chosen, or not.

    The item of the model is not used: its Python wrapper outlives it, and PySide then takes another
    object at the same address for that item.
    """
    field.setItemData(index, None if there else 0, _FLAGS)


#: The buttons fold where the choices would get less than this share of their width.
_CHOICES_SHARE = 0.8
_REFITTED = (QEvent.Type.LayoutRequest, QEvent.Type.FontChange, QEvent.Type.StyleChange)


class FoldedActions(QtWidgets.QWidget):
    """Buttons of actions; where there is no room for them, one button with a menu of all.

    Attributes
    ----------
    more
        The button with the menu.
    """

    def __init__(
        self, groups: Sequence[Sequence[QtGui.QAction]], parent: QtWidgets.QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._buttons, row = QtWidgets.QWidget(self), QtWidgets.QHBoxLayout(self)
        buttons = QtWidgets.QHBoxLayout(self._buttons)
        for layout in (row, buttons):
            layout.setContentsMargins(0, 0, 0, 0)
            layout.setSpacing(6)
        self.more = QtWidgets.QToolButton(self)
        self.more.setObjectName("more_actions")
        self.more.setText("»")
        self.more.setPopupMode(QtWidgets.QToolButton.ToolButtonPopupMode.InstantPopup)
        self.more.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        menu = QtWidgets.QMenu(self.more)
        for group in groups:
            line = QtWidgets.QFrame(self._buttons)
            line.setObjectName("bar_line")
            line.setFixedWidth(1)
            buttons.addWidget(line)
            menu.addSeparator()
            for action in group:
                button = QtWidgets.QToolButton(self._buttons)
                button.setDefaultAction(action)
                button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
                buttons.addWidget(button)
                menu.addAction(action)
        self.more.setMenu(menu)
        names = ", ".join(action.iconText() for group in groups for action in group)
        self.more.setAccessibleName(names)
        show_tooltip(self.more, names)
        row.addWidget(self._buttons)
        row.addWidget(self.more)
        self.fold(folded=False)

    @property
    def wanted_px(self) -> int:
        """Width in which all buttons stand beside each other."""
        return self._buttons.sizeHint().width()

    def fold(self, *, folded: bool) -> None:
        """Show the one button, or all of them."""
        self._buttons.setVisible(not folded)
        self.more.setVisible(folded)
        self.setFixedWidth((self.more if folded else self._buttons).sizeHint().width())


class WorkspaceButtons(QtWidgets.QWidget):
    """Buttons beside each other, one for each workspace."""

    def __init__(self, actions: Sequence[QtGui.QAction], parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("workspaces")
        buttons = [QtWidgets.QToolButton(self) for _ in actions]
        for button, action in zip(buttons, actions, strict=True):
            button.setDefaultAction(action)
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        in_row(*buttons, of=self, margins=0, gap_px=2).setContentsMargins(0, 2, UNIT_PX, 2)


class StudioBar(QtWidgets.QToolBar):
    """Choices, transport and a few actions; the actions fold before the choices are cut short.

    Parameters
    ----------
    choices, transport
        What stands in it.
    groups
        Actions, with a line before each group.
    window
        Its parent.

    Attributes
    ----------
    actions_at_end
        The buttons of the actions.
    """

    def __init__(
        self,
        choices: SetupBar,
        transport: QtWidgets.QWidget,
        groups: Sequence[Sequence[QtGui.QAction]],
        window: QtWidgets.QMainWindow,
    ) -> None:
        super().__init__("Setup", window)
        self._choices, self._transport = choices, transport
        self.actions_at_end = FoldedActions(groups)
        self.setObjectName("setup")
        self.setMovable(False)
        self.toggleViewAction().setVisible(False)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
        for part in (choices, transport, self.actions_at_end):
            self.addWidget(part)
        window.addToolBar(self)

    def event(self, event: QEvent) -> bool:
        if event.type() in _REFITTED:
            self._fit()
        return super().event(event)

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        layout = self.layout()
        if layout is None:
            return
        room = layout.contentsRect().width() - 2 * layout.spacing()
        room -= self._transport.sizeHint().width() + self.actions_at_end.wanted_px
        self.actions_at_end.fold(folded=room < _CHOICES_SHARE * self._choices.wanted_px)
