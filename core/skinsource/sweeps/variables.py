"""What a sweep can vary: a name and a value make one design of another."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any

from skinsource.actuators import load
from skinsource.chain import Actuation, ActuatorAt
from skinsource.clips import Clip
from skinsource.design import Design, Input
from skinsource.equalising import RegularisedInverse
from skinsource.errors import InvalidInputError
from skinsource.fields import specs_of
from skinsource.quoting import quoted

#: What a variable can be set to.
Value = bool | int | float | str | tuple[int, ...]

#: At all places, with the equaliser of the design; predictions then go through it.
ACTUATOR = "actuator"
OF_DESIGN = ("limb", "scaling", ACTUATOR)
OF_INPUT = ("location", "amplitude", "muted")
OF_CLIP = ("onset_s", "gain")
#: Inputs are numbered as they are listed: "2.frequency_hz" is of the second one alone.
_OF_ONE = "."


def varied(design: Design, name: str, value: Value) -> Design:
    """Return ``design`` with the variable ``name`` set to ``value``.

    Parameters
    ----------
    name
        ``"limb"``, ``"scaling"`` and ``"actuator"`` (at all places) of the design; ``"location"``,
        ``"amplitude"``, ``"muted"`` of inputs; ``"onset_s"`` and ``"gain"`` of clips; any field of
        waveforms: ``"frequency_hz"``.  Every input gets the value, clip by clip where they have the
        field; ``"2.frequency_hz"`` is of the second input alone.
    value
        A list of places for ``"location"`` goes to the inputs in their order.

    Raises
    ------
    InvalidInputError
        Nothing in the design has such a field, or the value does not fit it.
    """
    if name == "limb":
        # Whichever has the name; the digest is that of the one before.
        return replace(design, limb=value, limb_digest="")  # type: ignore[arg-type]
    if name == ACTUATOR:
        return replace(design, actuation=_actuation(design, value))
    if name in OF_DESIGN:
        return replace(design, **{name: value})  # type: ignore[arg-type]
    number, field = _read(name, len(design.inputs))
    if field == "location" and isinstance(value, tuple):
        return _placed(design, number, value)
    chosen = range(len(design.inputs)) if number is None else (number,)
    inputs = list(design.inputs)
    found = False
    for index in chosen:
        changed = _input_with(inputs[index], field, value)
        found = found or changed is not None
        inputs[index] = changed or inputs[index]
    if not found:
        raise InvalidInputError(
            f"nothing in the design has {quoted(name)}; a sweep can vary "
            f"{', '.join(names_in(design))}"
        )
    return replace(design, inputs=tuple(inputs))


def names_in(design: Design) -> tuple[str, ...]:
    """What can be varied in ``design``, without the numbers of inputs."""
    of_waveforms = {
        name: None for clip in design.clips for name in specs_of(clip.waveform) if clip.waveform
    }
    return (
        *OF_DESIGN,
        *(OF_INPUT if design.inputs else ()),
        *(OF_CLIP if design.clips else ()),
        *of_waveforms,
    )


def _actuation(design: Design, value: Value) -> Actuation:
    """One kind of actuator at all places; it follows the drives unless the design says else."""
    if not isinstance(value, str):
        raise InvalidInputError(f"actuator is {quoted(value)}, expected a name")
    equaliser = RegularisedInverse() if design.actuation is None else design.actuation.equaliser
    return Actuation(
        actuators=(ActuatorAt(actuator=value, model=load(value)),), equaliser=equaliser
    )


def _read(name: str, n_inputs: int) -> tuple[int | None, str]:
    """Index of the input that ``name`` speaks of, None: of all; and the field."""
    before, dot, field = name.partition(_OF_ONE)
    if not dot:
        return None, name
    if not (before.isdecimal() and len(before) < 10 and 1 <= int(before) <= n_inputs):
        raise InvalidInputError(
            f"the variable {quoted(name)} speaks of input {quoted(before)}; the design has "
            f"{n_inputs}, numbered from 1"
        )
    return int(before) - 1, field


def _placed(design: Design, number: int | None, places: tuple[int, ...]) -> Design:
    if number is not None or len(places) != len(design.inputs):
        raise InvalidInputError(
            f"location is {quoted(places)}, expected one place for each of the "
            f"{len(design.inputs)} inputs"
        )
    inputs = (
        replace(one, location=place) for one, place in zip(design.inputs, places, strict=True)
    )
    return replace(design, inputs=tuple(inputs))


def _input_with(one: Input, field: str, value: Value) -> Input | None:
    """The input with ``field`` set; None where it has none."""
    if field in OF_INPUT:
        return replace(one, **{field: value})  # type: ignore[arg-type]
    clips = _each(one.clips, lambda clip: _clip_with(clip, field, value))
    return None if clips is None else replace(one, clips=clips)


def _clip_with(clip: Clip, field: str, value: Value) -> Clip | None:
    if field in OF_CLIP:
        return replace(clip, **{field: value})  # type: ignore[arg-type]
    if field not in specs_of(clip.waveform):
        return None
    return replace(clip, waveform=replace(clip.waveform, **{field: value}))  # type: ignore[type-var]


def _each(clips: Iterable[Clip], change: Callable[[Clip], Clip | None]) -> tuple[Clip, ...] | None:
    """Clips changed where they can be; None where none can."""
    pairs: list[tuple[Clip, Any]] = [(clip, change(clip)) for clip in clips]
    if all(changed is None for _, changed in pairs):
        return None
    return tuple(changed or clip for clip, changed in pairs)
