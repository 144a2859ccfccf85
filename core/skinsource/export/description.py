"""What a file of signals or levels says of the design and the view that they belong to."""

from collections.abc import Iterable

from skinsource.chain import Actuation, ActuatorAt, amplitude_note
from skinsource.choice_words import AXES, METHODS, SCALINGS, SPANS, limb_word, word_of
from skinsource.clips import Clip
from skinsource.counting import counted
from skinsource.design import Input
from skinsource.scaling.response_scaling import Scaling


def describe_played(
    limb: str,
    note: str,
    scaling: Scaling,
    inputs: Iterable[Input],
    actuated: Actuation | None = None,
) -> list[str]:
    """Lines on the limb, by its name and what there is to note of it, and what it is driven by."""
    lines = [f"NOTE on the limb: {note}"] if note else []
    lines.append(
        f"limb: {limb_word(limb).title}, {limb}; scaling: {word_of(SCALINGS, scaling).both}"
    )
    meaning = amplitude_note(limb, "", scaling, actuated)
    if meaning:
        lines.append(f"amplitudes: {meaning}")
    if actuated is not None:
        lines.append(f"predicted through: {actuated.words}")
        lines += [f"  {_named(one)}: {one.model}" for one in actuated.actuators]
    for one in inputs:
        muted = ", muted" if one.muted else ""
        solo = ", solo" if one.solo else ""
        curve = f", gain curve {one.gain_curve}" if one.gain_curve else ""
        lines.append(
            f"input at place {one.location}: amplitude {one.amplitude!r}, "
            f"{counted(len(one.clips), 'clip')}{curve}{muted}{solo}"
        )
        lines += [f"  clip of the input at place {one.location}: {words_of(x)}" for x in one.clips]
    return lines


def _named(one: ActuatorAt) -> str:
    where = "all other places" if one.place is None else f"place {one.place}"
    return f"{where}, {one.actuator}" if one.actuator else where


def words_of(clip: Clip) -> str:
    """A clip in words: what it plays, from when on, through what."""
    gain = "" if clip.gain == 1.0 else f", gain {clip.gain!r}"
    through = "".join(f", {one}" for one in clip.effects if one.on)
    muted = ", muted" if clip.muted else ""
    return f"{clip.waveform}, onset {clip.onset_s!r} s{gain}{through}{muted}"


def describe_projection(axes: str, method: str) -> str:
    """Line on the axes and how they become one signal."""
    how = "" if len(axes) == 1 else f"; method: {word_of(METHODS, method).both}"
    return f"axes: {word_of(AXES, axes).both}{how}"


def describe_levels(span: str) -> str:
    """Line on what levels are the RMS over, which every file names, also those without levels.

    Who later puts a file of traces beside one of levels then sees whether they belong together.
    """
    return f"levels: RMS over the {word_of(SPANS, span).both.lower()}"
