"""The row above the panels: limb, scaling, axes, method."""

from dataclasses import replace
from functools import partial

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QAction, QStandardItemModel
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QSizePolicy, QWidget

from skinsource.design import Design
from skinsource.fields import ChoiceSpec
from skinsource.limb import HAND_LENGTHS_MM, LIMB_NAMES
from skinsource.projection import AXES, METHODS, Axes, Method
from skinsource.response_scaling import SCALINGS, Scaling
from skinsource.view import View
from skinsource_gui.widgets.fields.choice_field import ChoiceField

_ENABLED = Qt.ItemFlag.ItemIsEnabled
_SCALING_WORDS = {
    "upstream": (
        "Peak of each input",
        "Each input alone reaches its amplitude as largest skin "
        "acceleration, in m/s² (as the published toolbox does)",
    ),
    "relative": (
        "Equal drives",
        "No rescaling: strong and weak places keep their ratio; an "
        "amplitude of 1 is the measuring pulse",
    ),
    "probe": (
        "Probe acceleration",
        "Amplitudes are accelerations of the probe in m/s², within about 3 dB",
    ),
}
_AXES_WORDS = {"xy": "x, y", "xz": "x, z", "yz": "y, z", "xyz": "x, y, z"}
_METHOD_WORDS = {
    "mag": ("Magnitude", "Length of the acceleration vector"),
    "pca": ("Principal axis", "Component along the axis of largest variance"),
    "rms": ("RMS direction", "Component along the vector of the axes' RMS values"),
    "soc": ("Sum of components", "Sum over the chosen axes"),
}


class SetupBar(QWidget):
    """Choices for what the whole window shows."""

    design_edited = Signal(str, object, object)
    view_changed = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._design: Design | None = None
        self._view: View | None = None
        self._row = QHBoxLayout(self)
        self._row.setContentsMargins(0, 0, 0, 0)
        self._row.setSpacing(6)
        self._limb = self._choice("Limb", [(name, limb_words(name), "") for name in LIMB_NAMES])
        self._scaling = self._choice(
            "Scaling", [(name, *_SCALING_WORDS[name]) for name in SCALINGS]
        )
        self._axes = self._choice(
            "Axes", [(axes, _AXES_WORDS.get(axes, axes), "") for axes in AXES]
        )
        self._method = self._choice("Method", [(name, *_METHOD_WORDS[name]) for name in METHODS])
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
        self._method.setToolTip(
            "A single axis needs no method" if single else "How several axes become one signal"
        )

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

    def choices(self, parent: QObject) -> list[QAction]:
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

    def _choice(self, label: str, options: list[tuple[str, str, str]]) -> ChoiceField:
        spec = ChoiceSpec(label=label, options=tuple((value, words) for value, words, _ in options))
        field = ChoiceField(spec)
        field.setObjectName(label.lower())
        field.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        field.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Fixed)
        for index, (_, _, hint) in enumerate(options):
            field.setItemData(index, hint, Qt.ItemDataRole.ToolTipRole)
        title = QLabel(label)
        title.setBuddy(field)
        self._row.addWidget(title)
        self._row.addWidget(field)
        self._row.addSpacing(6)
        return field

    def _choose_limb(self, name: str, gesture: int | None) -> None:
        if self._design:
            changed = replace(self._design, limb=name)
            self.design_edited.emit(f"Change limb to {limb_words(name)}", changed, gesture)

    def _choose_scaling(self, scaling: Scaling, gesture: int | None) -> None:
        if self._design:
            self.design_edited.emit(
                "Change scaling", replace(self._design, scaling=scaling), gesture
            )

    def _choose_axes(self, axes: Axes) -> None:
        if self._view:
            self.view_changed.emit(replace(self._view, axes=axes))

    def _choose_method(self, method: Method) -> None:
        if self._view:
            self.view_changed.emit(replace(self._view, method=method))


def limb_words(name: str) -> str:
    """What a limb is called in the window, "Measured 1 (175 mm)"."""
    kind, _, number = name.partition("-")
    return f"{kind.capitalize()} {number} ({HAND_LENGTHS_MM[int(number) - 1]:g} mm)"
