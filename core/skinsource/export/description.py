"""What a file of signals or levels says of the design and the view that they belong to."""

from collections.abc import Iterable

from skinsource.choice_words import AXES, LIMBS, METHODS, SCALINGS, SPANS, word_of
from skinsource.design import Input


def describe_played(limb: str, note: str, scaling: str, inputs: Iterable[Input]) -> list[str]:
    """Lines on the limb, by its name and what there is to note of it, scaling and inputs."""
    lines = [f"NOTE on the limb: {note}"] if note else []
    lines.append(
        f"limb: {word_of(LIMBS, limb).title}, {limb}; scaling: {word_of(SCALINGS, scaling).both}"
    )
    for one in inputs:
        muted = ", muted" if one.muted else ""
        solo = ", solo" if one.solo else ""
        lines.append(
            f"input at place {one.location}: {one.waveform}, amplitude {one.amplitude!r}, "
            f"onset {one.onset_s!r} s{muted}{solo}"
        )
    return lines


def describe_projection(axes: str, method: str) -> str:
    """Line on the axes and how they become one signal."""
    how = "" if len(axes) == 1 else f"; method: {word_of(METHODS, method).both}"
    return f"axes: {word_of(AXES, axes).both}{how}"


def describe_levels(span: str) -> str:
    """Line on what levels are the RMS over, which every file names, also those without levels.

    Who later puts a file of traces beside one of levels then sees whether they belong together.
    """
    return f"levels: RMS over the {word_of(SPANS, span).both.lower()}"
