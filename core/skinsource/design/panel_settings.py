"""Settings that belong to one panel: frozen dataclasses, stored in `View.panels` as plain data.

A panel's settings are a frozen dataclass whose fields are made with `skinsource.specs.fields`, so
that files can hold the settings of panels that this library does not know.
"""

from contextlib import suppress
from dataclasses import dataclass, replace
from dataclasses import fields as dataclass_fields
from typing import Any, TypeVar

from skinsource.base.errors import InvalidInputError
from skinsource.design.design import Plain, View
from skinsource.specs import fields
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec, SwitchSpec

Settings = TypeVar("Settings")


def settings_of(view: View, panel: str, kind: type[Settings]) -> Settings:
    """Return the settings of one panel.

    A field that is not in the view, or whose value is not allowed, has its default: settings of a
    panel must not prevent opening a design.
    """
    stored = dict(dict(view.panels).get(panel, ()))
    settings = kind()
    for field in dataclass_fields(settings):  # type: ignore[arg-type]
        if field.name in stored:
            with suppress(InvalidInputError):
                changed = {field.name: stored[field.name]}
                settings = replace(settings, **changed)  # type: ignore[type-var]
    return settings


def with_settings(view: View, panel: str, settings: Any) -> View:
    """Return ``view`` with these settings of one panel; unknown fields stay.

    Defaults are not stored, so that views that show the same are equal.
    """
    panels = dict(view.panels)
    stored: dict[str, Plain] = dict(panels.pop(panel, ()))
    defaults = type(settings)()
    for field in dataclass_fields(settings):
        stored.pop(field.name, None)
        if getattr(settings, field.name) != getattr(defaults, field.name):
            stored[field.name] = getattr(settings, field.name)
    if stored:
        panels[panel] = tuple(stored.items())
    return replace(view, panels=tuple(panels.items()))


#: Name of the panel that is presented, and what it was called in files before.
STAGE, _BEFORE = "stage", "frequency_and_amplitude"
ALL, FREQUENCY, AMPLITUDE, ONSET = "all", "frequency", "amplitude", "onset"
CONTROL = ChoiceSpec(
    label="Knob",
    options=(
        (ALL, "Automatic"),
        (FREQUENCY, "Frequency"),
        (AMPLITUDE, "Amplitude"),
        (ONSET, "Onset"),
    ),
    hint="Number that the knob changes",
)
COMPARED = SwitchSpec(label="Compared", hint="Show what the Compare panel compares")
PLOT = ChoiceSpec(
    label="Beside the maps",
    options=(("traces", "Traces"), ("spectra", "Spectra")),
    hint="Plot of the selected outputs",
)
MOVES = SwitchSpec(label="In motion", hint="Show motion; else RMS levels")


@dataclass(frozen=True, slots=True, kw_only=True)
class StageSettings(fields.CheckedModel):
    """What is presented of a design.

    Attributes
    ----------
    control
        The number that is turned; `ALL`: the frequency where there is one, else the amplitude.
    compared
        Whether what the Compare panel compares is shown, or the design alone.
    moves
        Whether it is shown in motion.
    plot
        ``"traces"`` or ``"spectra"`` of the selected outputs.
    """

    control: str = fields.choice(ALL, CONTROL)
    compared: bool = fields.switch(False, COMPARED)
    moves: bool = fields.switch(True, MOVES)
    plot: str = fields.choice("traces", PLOT)


def stage_settings(view: View) -> StageSettings:
    """Return what is presented of the design of a view."""
    settings = settings_of(view, STAGE, StageSettings)
    if settings.control != ALL:
        return settings
    return replace(settings, control=settings_of(view, _BEFORE, StageSettings).control)


WINDOW = ChoiceSpec(
    label="Window",
    options=(("25", "25 ms"), ("50", "50 ms"), ("100", "100 ms"), ("200", "200 ms")),
    hint="Short windows resolve time, long ones frequency",
)
FLOOR = NumberSpec(label="Floor", unit="Hz", minimum=0.0, maximum=1e5, step=5.0)
CEILING = NumberSpec(label="Ceiling", unit="Hz", minimum=1.0, maximum=1e5, step=5.0)
OUTPUT = NumberSpec(label="Output", minimum=0, maximum=1e6, whole=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class SpectrogramSettings(fields.CheckedModel):
    """How a spectrogram is made and drawn.

    Attributes
    ----------
    window_ms
        Length of the window: ``"25"``, ``"50"``, ``"100"`` or ``"200"``.
    output
        The selected output that is shown; 0, or one that is not selected: the last one.
    floor_hz, ceiling_hz
        Range that is drawn, up to half the rate of the limb; a ceiling that is not above the floor
        counts as half the rate.
    """

    window_ms: str = fields.choice("50", WINDOW)
    output: int = fields.number(0, OUTPUT)
    floor_hz: float = fields.number(0.0, FLOOR)
    ceiling_hz: float = fields.number(CEILING.maximum, CEILING)

    @property
    def window_s(self) -> float:
        """Length of the window."""
        return float(self.window_ms) * 1e-3


#: Name of the panel of targets; the skin map paints with its brush.
TARGET = "target"
NO_BRUSH = "select"
BRUSH = ChoiceSpec(
    label="Brush",
    options=(
        (NO_BRUSH, "Select"),
        ("strong", "Strong"),
        ("quiet", "Quiet"),
        ("erase", "Erase"),
    ),
    hint="What a click or drag on the skin map does",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class TargetSettings(fields.CheckedModel):
    """What a click or drag on the skin map does: selects, or paints with a ``brush``."""

    brush: str = fields.choice(NO_BRUSH, BRUSH)


def brush_of(view: View) -> str:
    """Return with what the skin map paints; "": it selects outputs."""
    brush = settings_of(view, TARGET, TargetSettings).brush
    return "" if brush == NO_BRUSH else brush
