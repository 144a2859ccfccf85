"""From one kind of waveform to another."""

from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

from skinsource.errors import InvalidInputError
from skinsource.fields import ChoiceSpec, NumberSpec, SamplesSpec, Spec, specs_of
from skinsource.samples import Samples
from skinsource.waveforms import Glide, Waveform, kinds


@dataclass(frozen=True, slots=True, kw_only=True)
class KindSpec(ChoiceSpec):
    """A choice among kinds of waveforms."""


def kind_spec() -> KindSpec:
    """What an input may play."""
    return KindSpec(
        label="Waveform",
        options=tuple((kind.__name__, kind.title) for kind in kinds()),
        hint="What this input plays",
    )


def kind_name(waveform: Waveform) -> str:
    """Option of `kind_spec` that a waveform is."""
    return type(waveform).__name__


def as_kind(waveform: Waveform, kind: type[Waveform], rate_hz: float) -> Waveform:
    """A waveform of another kind that shares what it can with ``waveform``.

    A number that the other kind does not allow becomes the nearest one that it does.  A kind that
    holds samples gets those that ``waveform`` plays at ``rate_hz``, the rate of the limb.
    """
    if kind is type(waveform):
        return waveform
    present = specs_of(waveform)
    found: Any = Glide.like(waveform) if kind is Glide else kind()
    for field, spec in specs_of(kind).items():
        change: dict[str, Any] = {}
        if isinstance(spec, SamplesSpec):
            change = _played(waveform, field, spec, rate_hz)
        elif type(present.get(field)) is type(spec):
            change = _shared(waveform, field, spec)
        # What does not go together with the rest stays as it is in a new one.
        with suppress(InvalidInputError):
            found = replace(found, **change)
    return found


def _shared(waveform: Waveform, field: str, spec: Spec) -> dict[str, Any]:
    """The value of a field of both kinds, as the new one allows it."""
    value = getattr(waveform, field)
    if isinstance(spec, NumberSpec):
        return {field: nearest(value, spec)}
    return {field: value} if isinstance(spec, ChoiceSpec) and value in dict(spec.options) else {}


def _played(
    waveform: Waveform, field: str, spec: SamplesSpec, rate_hz: float
) -> dict[str, Samples]:
    """What a waveform plays, as the samples of ``field``; nothing where it cannot be."""
    own = getattr(waveform, field, None)
    try:
        if isinstance(own, Samples):
            played = own if spec.unit is None else replace(own, unit=spec.unit)
        else:
            played = Samples(values=waveform.samples(rate_hz), sample_rate_hz=rate_hz)
        return {field: spec.checked(played)}
    except InvalidInputError:
        return {}


def nearest(value: float, spec: NumberSpec) -> float:
    """The allowed number nearest to ``value``."""
    within = min(max(value, spec.minimum), spec.maximum)
    return round(within) if spec.whole else float(within)
