"""How far an actuator may be driven, and how it warms."""

from dataclasses import dataclass

from skinsource import fields
from skinsource.fields import SMALLEST, NumberSpec, OptionalSpec, specs_of


def _limit(label: str, unit: str, hint: str, most: float = float("inf")) -> OptionalSpec:
    return OptionalSpec(
        label=label,
        hint=hint,
        of=NumberSpec(
            label=label, unit=unit, minimum=SMALLEST, maximum=most, step=0.02, logarithmic=True
        ),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """What must not be passed; None: nothing is known, and nothing is limited.

    Attributes
    ----------
    peak_voltage_v, rms_voltage_v
        Largest voltage, and its RMS over the loudest second.
    slew_v_per_s
        Fastest change of the voltage.
    duration_s
        Longest stimulus.
    displacement_m
        Farthest the contactor may go from rest, to either side.
    peak_current_a, rms_current_a
        Largest current, and its RMS over the loudest second.
    duty
        Largest share of the time in which it is driven, above 0 to 1.
    """

    peak_voltage_v: float | None = fields.field(_limit("Peak voltage", "V", "Largest"), None)
    rms_voltage_v: float | None = fields.field(
        _limit("RMS voltage", "V", "Over the loudest second"), None
    )
    slew_v_per_s: float | None = fields.field(_limit("Slew", "V/s", "Fastest change"), None)
    duration_s: float | None = fields.field(_limit("Duration", "s", "Longest stimulus"), None)
    displacement_m: float | None = fields.field(
        _limit("Displacement", "m", "Farthest from rest, to either side"), None
    )
    peak_current_a: float | None = fields.field(_limit("Peak current", "A", "Largest"), None)
    rms_current_a: float | None = fields.field(
        _limit("RMS current", "A", "Over the loudest second"), None
    )
    duty: float | None = fields.field(
        _limit("Duty", "", "Largest share of the time in which it is driven", 1.0), None
    )

    def __post_init__(self) -> None:
        fields.check(self)


def limit_words(name: str) -> str:
    """What a field of `Limits` is called in the middle of a sentence."""
    label = _spec_of(name).label
    return label if label[1].isupper() else label[0].lower() + label[1:]


def with_unit(name: str, value: float) -> str:
    """A value of a field of `Limits`, with its unit."""
    return f"{value:.4g} {_spec_of(name).unit}".rstrip()


def _spec_of(name: str) -> NumberSpec:
    spec = specs_of(Limits)[name]
    if not (isinstance(spec, OptionalSpec) and isinstance(spec.of, NumberSpec)):
        raise KeyError(name)
    return spec.of


@dataclass(frozen=True, slots=True, kw_only=True)
class Thermal:
    """How the coil warms: one heat capacity behind one thermal resistance.

    Attributes
    ----------
    resistance_k_per_w
        Rise of the temperature for each watt, in the end.
    time_constant_s
        After which 63 % of it are reached.
    """

    resistance_k_per_w: float = fields.field(
        NumberSpec(label="Thermal resistance", unit="K/W", minimum=SMALLEST)
    )
    time_constant_s: float = fields.field(
        NumberSpec(label="Thermal time constant", unit="s", minimum=SMALLEST)
    )

    def __post_init__(self) -> None:
        fields.check(self)
