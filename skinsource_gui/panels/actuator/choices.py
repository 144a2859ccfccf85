"""The fields of the panel: which actuator, its parameters, and the equaliser."""

from dataclasses import replace
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QLabel, QPushButton, QVBoxLayout, QWidget

from skinsource.engine.actuator_demand import ActuatorSettings, actuator_spec
from skinsource.specs.fields import NumberSpec, Spec, specs_of
from skinsource_gui.theme import UNIT_PX, set_tone
from skinsource_gui.widgets.fields.field_cell import FieldCell
from skinsource_gui.widgets.fields.field_grid import FieldGrid
from skinsource_gui.widgets.fields.units import value_text

_OF_EQUALISER = {
    "inverse": ("boost_db", "phase", "strength_m_per_s2"),
    "pole_pair": ("new_quality", "strength_m_per_s2"),
    "none": ("volts",),
}
_OF_AMPLITUDES = ("strength_m_per_s2", "volts")
_PARAMETER = "parameter "


class ActuatorChoices(QObject):
    """Cells for all that can be chosen; those are shown that mean something now.

    Attributes
    ----------
    grid
        Cells of the actuator and its equaliser.
    details
        The parameters of the model, and where they come from.
    """

    #: The new `ActuatorSettings`, number of the gesture or None.
    changed = Signal(object, object)
    #: A response that was measured shall be opened.
    measured_wanted = Signal()

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._settings, self._predicted = ActuatorSettings(), False
        self._shown: tuple[object, ...] | None = None
        self._cells: tuple[FieldCell, ...] = ()
        self._kept: dict[tuple[str, Spec], FieldCell] = {}
        self.grid, self._parameters = FieldGrid(), FieldGrid()
        self.details = QWidget()
        self.about = QLabel()
        self.about.setObjectName("actuator_about")
        set_tone(self.about, "dim")
        self.about.setWordWrap(True)
        self.about.setTextInteractionFlags(Qt.TextInteractionFlag.NoTextInteraction)
        self.reset = QPushButton("As listed")
        self.reset.setObjectName("actuator_reset")
        self.reset.setToolTip("Give all parameters back the values that the library lists")
        self.reset.clicked.connect(self._reset)
        self.open = QPushButton("Measured response…")
        self.open.setObjectName("actuator_open")
        self.open.setToolTip(
            "From a table with frequency_hz, gain and phase, or from sound with the voltage of a "
            "sweep and what the accelerometer said"
        )
        self.open.clicked.connect(self.measured_wanted)
        column = QVBoxLayout(self.details)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(UNIT_PX // 2)
        column.addWidget(self._parameters)
        column.addWidget(self.about)
        column.addWidget(self.reset, 0, Qt.AlignmentFlag.AlignLeft)
        column.addWidget(self.open, 0, Qt.AlignmentFlag.AlignLeft)

    def cell(self, name: str) -> FieldCell:
        """The cell of a setting, or of ``"parameter "`` and a field of the model."""
        return next(one for one in self._cells if one.name == name)

    def show_settings(self, settings: ActuatorSettings, *, predicted: bool = False) -> None:
        """Show these settings; ``predicted``: amplitudes have a unit of their own."""
        self._settings, self._predicted = settings, predicted
        model = settings.model
        equaliser = settings.equaliser if model is not None else None
        shown = (type(model), equaliser, predicted, settings.measured_title)
        if shown != self._shown:
            self._shown = shown
            self._build()
        for cell in self._cells:
            if cell.name.startswith(_PARAMETER):
                cell.set_value(getattr(model, cell.name.removeprefix(_PARAMETER)))
            else:
                cell.set_value(getattr(settings, cell.name))
        self.about.setText(self._words())
        self.reset.setVisible(bool(settings.parameters))

    def _build(self) -> None:
        """Show the cells that there are now; each is made once, and those not shown are hidden."""
        model = self._settings.model
        wanted: dict[str, Spec] = {"actuator": actuator_spec(self._settings.measured_title)}
        if model is not None:
            own = specs_of(self._settings)
            names = ("equaliser", *_OF_EQUALISER[self._settings.equaliser])
            hidden = _OF_AMPLITUDES if self._predicted else ()
            wanted |= {name: own[name] for name in names if name not in hidden}
            wanted |= {
                f"{_PARAMETER}{name}": spec
                for name, spec in specs_of(model).items()
                if isinstance(spec, NumberSpec)
            }
        for name, spec in wanted.items():
            if (name, spec) not in self._kept:
                cell = FieldCell(name, spec)
                cell.edited.connect(self._edit)
                self._kept[name, spec] = cell
        self._cells = tuple(self._kept[one] for one in wanted.items())
        parameters = tuple(cell for cell in self._cells if cell.name.startswith(_PARAMETER))
        self.grid.show_cells([cell for cell in self._cells if cell not in parameters])
        self._parameters.show_cells(parameters)

    def _words(self) -> str:
        profile = self._settings.profile
        known = profile.calibration
        lines = [profile.source, f"Calibrated: {known[:1].lower()}{known[1:]}"]
        changed = []
        for name, value in dict(self._settings.parameters).items():
            spec = specs_of(profile.model).get(name)
            if isinstance(spec, NumberSpec):
                before = value_text(getattr(profile.model, name), spec.unit, 4)
                changed.append(f"{spec.label} {before} → {value_text(value, spec.unit, 4)}")
        if changed:
            lines.append(f"Changed: {', '.join(changed)}.")
        return " ".join(lines)

    def _edit(self, name: str, value: Any, gesture: object) -> None:
        if name.startswith(_PARAMETER):
            settings = self._settings.with_parameter(name.removeprefix(_PARAMETER), value)
        elif name == "actuator":
            settings = replace(self._settings, actuator=value, parameters=(), zoom=None)
        else:
            changed: dict[str, Any] = {name: value}
            settings = replace(self._settings, **changed)
        if settings != self._settings:
            self.changed.emit(settings, gesture)

    def _reset(self) -> None:
        self.changed.emit(replace(self._settings, parameters=()), None)
