"""Numbers and choices of inputs, of their clips, and of what those play."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Any

from skinsource.clips import GAIN, ONSET, Clip
from skinsource.clips.clip import LABEL
from skinsource.design import AMPLITUDE, GAIN_CURVE, Design, Input
from skinsource.edits.edit import NOTHING_CHOSEN, Edit, Refusal, changed, present, refused
from skinsource.edits.kinds import as_kind, nearest
from skinsource.edits.parts import changing_words
from skinsource.edits.selection import clip_of, clips_of
from skinsource.errors import InvalidInputError
from skinsource.fields import NumberSpec, Spec, specs_of
from skinsource.own_limbs import facts_of
from skinsource.quoting import quoted
from skinsource.view import View
from skinsource.waveforms import Waveform, kinds

_OF_TRACK: dict[str, Spec] = {"amplitude": AMPLITUDE, "gain_curve": GAIN_CURVE}
_OF_CLIP: dict[str, Spec] = {"onset_s": ONSET, "gain": GAIN, "label": LABEL}


def change_kind(design: Design, view: View, ids: Iterable[int], kind: str) -> Edit | Refusal:
    """Let clips of inputs play another kind of waveform, with what both kinds share."""
    wanted = next((one for one in kinds() if one.__name__ == kind), None)
    if wanted is None:
        known = ", ".join(one.__name__ for one in kinds())
        return Refusal(sentence=f"No waveform is called {quoted(kind)}; there are {known}.")
    rate_hz = facts_of(design.limb).sample_rate_hz
    return _playing(design, view, ids, lambda clip: as_kind(clip.waveform, wanted, rate_hz))


def change_waveform(
    design: Design, view: View, ids: Iterable[int], waveform: Waveform
) -> Edit | Refusal:
    """Let clips of inputs play a waveform."""
    return _playing(design, view, ids, lambda _: waveform)


def change_field(
    design: Design, view: View, ids: Iterable[int], name: str, value: Any
) -> Edit | Refusal:
    """Set a number or a choice of inputs, of their clips, or of what those play, to one value.

    Inputs without a clip, and clips whose waveform has no field of this name, are left as they are.
    """
    targets = _targets(design, view, ids, name)
    if not targets:
        return NOTHING_CHOSEN
    return _set(design, view, name, [(target, value) for target in targets])


def drag_field(
    design: Design,
    view: View,
    ids: Iterable[int],
    name: str,
    value: float,
    *,
    lead: int | None,
    start: Design,
) -> Edit | Refusal:
    """Set a number of the input ``lead``, or its clip; the others move as far from where they were.

    They move by the same step, or by the same factor where the number is logarithmic, and stay
    within what is allowed.  ``start`` is the design as the drag began: the way back leads to it.
    """
    ids = tuple(ids)
    targets = _targets(design, view, ids, name)
    dragged = next((one for one in targets if one.leads(lead, view)), None)
    if dragged is None or not isinstance(dragged.spec(name), NumberSpec):
        return change_field(design, view, ids, name, value)
    began = {one.key: one for one in _targets(start, view, start.ids, name)}
    origin = began.get(dragged.key, dragged).value(name)
    try:
        dragged.spec(name).checked(value)
        values = [(dragged, value)]
        for one in targets:
            spec = one.spec(name)
            if one is not dragged and isinstance(spec, NumberSpec):
                own = began.get(one.key, one).value(name)
                values.append((one, _moved(own, origin, value, spec)))
    except InvalidInputError as error:
        return refused(error)
    return _set(design, view, name, values)


def fields_of(one: Input, clip: Clip | None = None) -> dict[str, Spec]:
    """What of an input can be set: amplitude, gain curve, and fields of its clip and what it plays.

    ``clip`` is one of its clips; None: its first, if it has any.
    """
    clip = clip or next(iter(one.clips), None)
    return {**_OF_TRACK} if clip is None else {**_OF_TRACK, **_OF_CLIP, **specs_of(clip.waveform)}


def value_of(one: Input, name: str, clip: Clip | None = None) -> Any:
    """Value of one of `fields_of`."""
    clip = clip or next(iter(one.clips), None)
    holder: Any = one if name in _OF_TRACK else clip
    return getattr(holder if name in _OF_TRACK | _OF_CLIP else holder.waveform, name)


@dataclass(frozen=True, slots=True)
class _Target:
    """An input, or one of its clips, of which a field is set."""

    track: Input
    clip: Clip | None

    @property
    def key(self) -> tuple[int, int]:
        return self.track.id, 0 if self.clip is None else self.clip.id

    def leads(self, lead: int | None, view: View) -> bool:
        apart = self.clip is None or self.clip is clip_of(self.track, view)
        return self.track.id == lead and apart

    def spec(self, name: str) -> Spec:
        return fields_of(self.track, self.clip)[name]

    def value(self, name: str) -> Any:
        return value_of(self.track, name, self.clip)

    def setting(self, name: str, value: Any) -> dict[str, Any]:
        """Changes of the input, or of the clip, that give the field its value."""
        if self.clip is None or name in _OF_CLIP:
            return {name: value}
        waveform: Any = self.clip.waveform
        return {"waveform": replace(waveform, **{name: value})}


def _targets(design: Design, view: View, ids: Iterable[int], name: str) -> list[_Target]:
    chosen = present(design, ids)
    if name in _OF_TRACK:
        return [_Target(one, None) for one in chosen]
    pairs = [_Target(one, clip) for one in chosen for clip in clips_of(one, view)]
    return [one for one in pairs if name in fields_of(one.track, one.clip)]


def _set(
    design: Design, view: View, name: str, values: list[tuple[_Target, Any]]
) -> Edit | Refusal:
    changes: dict[int, dict[str, Any]] = {}
    of_clips: dict[int, dict[str, Any]] = {}
    try:
        for target, value in values:
            setting = target.setting(name, value)
            changes[target.track.id] = setting if target.clip is None else {}
            if target.clip is not None:
                of_clips[target.clip.id] = setting
    except InvalidInputError as error:
        return refused(error)
    target, value = values[0]
    verb = changing_words(target.spec(name), target.value(name), value)
    return changed(design, view, verb, changes, of_clips)


def _playing(
    design: Design, view: View, ids: Iterable[int], waveform: Callable[[Clip], Waveform]
) -> Edit | Refusal:
    changes: dict[int, dict[str, Any]] = {}
    of_clips: dict[int, dict[str, Any]] = {}
    try:
        for one in present(design, ids):
            # What plays nothing yet begins to.
            changes[one.id] = {} if one.clips else {"clips": (Clip(waveform=waveform(Clip())),)}
            for clip in clips_of(one, view):
                of_clips[clip.id] = {"waveform": waveform(clip)}
    except InvalidInputError as error:
        return refused(error)
    return changed(design, view, "Change waveform of", changes, of_clips)


def _moved(own: float, origin: float, value: float, spec: NumberSpec) -> float:
    """``own`` moved as ``origin`` was to become ``value``."""
    by_factor = spec.logarithmic and min(own, origin, value) > 0
    moved = own * (value / origin) if by_factor else own + (value - origin)
    # Sums of decimal steps shall be short to read.
    return nearest(float(f"{moved:.12g}"), spec)
