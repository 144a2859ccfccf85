"""From one kind of waveform to another."""

from typing import Any

from skinsource.fields import ChoiceSpec, NumberSpec, specs_of
from skinsource.waveforms import KINDS, Waveform
from skinsource_gui.widgets.fields.number_steps import clamped

#: What is called what.
KIND_SPEC = ChoiceSpec(
    label="Waveform",
    options=tuple((kind.__name__, kind.title) for kind in KINDS),
    hint="What this input plays",
)


def kind_name(waveform: Waveform) -> str:
    """Option of `KIND_SPEC` that a waveform is."""
    return type(waveform).__name__


def as_kind(waveform: Waveform, name: str) -> Waveform:
    """A waveform of kind ``name`` that shares what it can with ``waveform``.

    A number that the other kind does not allow becomes the nearest one that it does.
    """
    kind = next(kind for kind in KINDS if kind.__name__ == name)
    if kind is type(waveform):
        return waveform
    present = specs_of(waveform)
    shared: dict[str, Any] = {}
    for field, spec in specs_of(kind).items():
        if type(present.get(field)) is not type(spec):
            continue
        value = getattr(waveform, field)
        if isinstance(spec, NumberSpec):
            shared[field] = round(clamped(value, spec)) if spec.whole else clamped(value, spec)
        elif value in dict(spec.options):
            shared[field] = value
    return kind(**shared)
