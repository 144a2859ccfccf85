"""What only one panel looks at: its own frozen settings, kept in `View.panels` as plain data.

A panel's settings are a frozen dataclass whose fields are made with `skinsource.specs.fields`, so
that files can hold the settings of panels that this library does not know.
"""

from dataclasses import dataclass, replace
from dataclasses import fields as dataclass_fields
from typing import Any, TypeVar, cast

from skinsource.base.errors import InvalidInputError
from skinsource.design.view import Plain, View
from skinsource.specs import fields
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec

Settings = TypeVar("Settings")

# Settings that were asked for last, and what they were read from: while something is dragged they
# are asked for many times.  By identity: equal plain data need not be of the same types.
_latest: dict[tuple[str, type], tuple[object, object]] = {}


def settings_of(view: View, panel: str, kind: type[Settings]) -> Settings:
    """Return the settings of one panel.

    A field that the view does not hold has its default, and so has one whose value does not fit
    its specification: what is only looked at must not keep a design from being seen.
    """
    cached = _latest.get((panel, kind))
    if cached is not None and cached[0] is view.panels:
        return cast(Settings, cached[1])
    stored = dict(dict(view.panels).get(panel, ()))
    settings = kind()
    for field in dataclass_fields(settings):  # type: ignore[arg-type]
        if field.name in stored:
            settings = _with_field(settings, field.name, stored[field.name])
    _latest[panel, kind] = view.panels, settings
    return settings


def with_settings(view: View, panel: str, settings: Any) -> View:
    """Return ``view`` with these settings of one panel; fields it does not know are kept.

    What is as by default is not held, so that views that look alike are equal.
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


def _with_field(settings: Settings, name: str, value: Plain) -> Settings:
    try:
        return replace(settings, **{name: value})  # type: ignore[type-var]
    except InvalidInputError:
        return settings


# What panels of analysis choose and their quantities depend on.

WINDOW = ChoiceSpec(
    label="Window",
    options=(("25", "25 ms"), ("50", "50 ms"), ("100", "100 ms"), ("200", "200 ms")),
    hint="Short windows tell instants apart, long ones frequencies",
)
FLOOR = NumberSpec(label="Floor", unit="Hz", minimum=0.0, maximum=1e5, step=5.0)
CEILING = NumberSpec(label="Ceiling", unit="Hz", minimum=1.0, maximum=1e5, step=5.0)
OUTPUT = NumberSpec(label="Output", minimum=0, maximum=1e6, whole=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class SpectrogramSettings:
    """How a spectrogram is made and drawn.

    Attributes
    ----------
    window_ms
        Length of the window: ``"25"``, ``"50"``, ``"100"`` or ``"200"``.
    output
        Of which of the selected outputs; 0, or one that is not selected: of the last one.
    floor_hz, ceiling_hz
        What is drawn, up to half the rate of the limb; a ceiling that is not above the floor counts
        as that.
    """

    window_ms: str = fields.choice("50", WINDOW)
    output: int = fields.number(0, OUTPUT)
    floor_hz: float = fields.number(0.0, FLOOR)
    ceiling_hz: float = fields.number(CEILING.maximum, CEILING)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def window_s(self) -> float:
        """Length of the window."""
        return float(self.window_ms) * 1e-3
