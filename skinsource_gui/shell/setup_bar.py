"""The row above the panels: limb, scaling, axes, method."""

from dataclasses import replace
from functools import partial

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QAction, QStandardItemModel
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QSizePolicy, QWidget

from skinsource.design import Design
from skinsource.edits import Edit
from skinsource.fields import ChoiceSpec
from skinsource.limb import LIMB_NAMES
from skinsource.projection import Axes, Method
from skinsource.response_scaling import Scaling
from skinsource.view import View
from skinsource.words import CHOICES, LIMBS, Word, word_of
from skinsource_gui.widgets.fields.choice_field import ChoiceField
from skinsource_gui.widgets.tooltips import tooltip

_ENABLED = Qt.ItemFlag.ItemIsEnabled


class SetupBar(QWidget):
    """Choices for what the whole window shows."""

    #: `Edit` or `Refusal`, number of the gesture or None.
    edited = Signal(object, object)
    view_changed = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._design: Design | None = None
        self._view: View | None = None
        self._row = QHBoxLayout(self)
        self._row.setContentsMargins(0, 0, 0, 0)
        self._row.setSpacing(6)
        self._limb, self._scaling, self._axes, self._method = (
            self._choice(label, sentence, words)
            for field, label, sentence, words in CHOICES
            if field != "span"
        )
        self._method_hint = self._method.toolTip()
        self._row.addStretch(1)
        self._limb.chosen.connect(self._choose_limb)
        self._scaling.chosen.connect(self._choose_scaling)
        self._axes.chosen.connect(self._choose_axes)
        self._method.chosen.connect(self._choose_method)

    def show_state(self, design: Design, view: View) -> None:
        """Take over the present design and view."""
        self._design, self._view = design, view
        for field, value in (
            (self._limb, design.limb),
            (self._scaling, design.scaling),
            (self._axes, view.axes),
            (self._method, view.method),
        ):
            field.set_value(value)
        single = len(view.axes) == 1
        self._method.setEnabled(not single)
        self._method.setToolTip("A single axis needs no method" if single else self._method_hint)

    def show_available(self, limbs: tuple[str, ...]) -> None:
        """Offer these limbs, and no others."""
        model = self._limb.model()
        if not isinstance(model, QStandardItemModel):
            return
        for index, name in enumerate(LIMB_NAMES):
            there = name in limbs
            item = model.item(index)
            item.setEnabled(there)
            item.setToolTip(
                "" if there else "Not installed; Help > Get the measured limbs… says how"
            )

    def choices(self, parent: QObject | None) -> list[QAction]:
        """One action for each choice that can be made, owned by ``parent``."""
        actions = []
        for field in (self._limb, self._scaling, self._axes, self._method):
            model = field.model()
            for index in range(field.count()):
                action = QAction(f"{field.accessibleName()}: {field.itemText(index)}", parent)
                action.setToolTip(field.itemData(index, Qt.ItemDataRole.ToolTipRole) or "")
                action.setEnabled(
                    field.isEnabled() and bool(model.flags(model.index(index, 0)) & _ENABLED)
                )
                action.triggered.connect(partial(field.choose, field.itemData(index)))
                actions.append(action)
        return actions

    def _choice(self, label: str, sentence: str, words: tuple[Word, ...]) -> ChoiceField:
        options = tuple((word.name, word.title) for word in words)
        field = ChoiceField(ChoiceSpec(label=label, options=options, hint=sentence))
        field.setObjectName(label.lower())
        field.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        field.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Fixed)
        for index, word in enumerate(words):
            field.setItemData(index, tooltip(word.sentence), Qt.ItemDataRole.ToolTipRole)
        title = QLabel(label)
        title.setBuddy(field)
        self._row.addWidget(title)
        self._row.addWidget(field)
        self._row.addSpacing(6)
        return field

    def _choose_limb(self, name: str, gesture: int | None) -> None:
        if self._design:
            self._edit(f"Change limb to {word_of(LIMBS, name).title}", gesture, limb=name)

    def _choose_scaling(self, scaling: Scaling, gesture: int | None) -> None:
        if self._design:
            self._edit("Change scaling", gesture, scaling=scaling)

    def _edit(self, label: str, gesture: int | None, **changes: str) -> None:
        if self._design and self._view:
            design = replace(self._design, **changes)
            self.edited.emit(Edit(label=label, design=design, view=self._view), gesture)

    def _choose_axes(self, axes: Axes) -> None:
        if self._view:
            self.view_changed.emit(replace(self._view, axes=axes))

    def _choose_method(self, method: Method) -> None:
        if self._view:
            self.view_changed.emit(replace(self._view, method=method))
