"""Field specifications and steps that several motions share."""

from collections.abc import Iterable
from dataclasses import replace

from skinsource.clips import Clip
from skinsource.design import AMPLITUDE, PLACE, Input
from skinsource.fields import ListSpec, NumberSpec, RecipeSpec
from skinsource.waveforms import kinds

#: Places of one path; a place may come again.
MAX_PATH = 100

PATH = ListSpec(label="Path", of=PLACE, fewest=2, most=MAX_PATH, hint="Places, in their order")
WAVEFORM = RecipeSpec(label="Waveform", kinds=kinds, hint="What plays at each place")
START = NumberSpec(
    label="Start", unit="s", minimum=0.0, maximum=600.0, step=0.005, hint="When it begins"
)
SPACING = NumberSpec(
    label="Spacing",
    unit="s",
    minimum=0.001,
    maximum=60.0,
    step=0.005,
    hint="From the start of one to the start of the next",
)
LEVEL = replace(AMPLITUDE, minimum=0.0, hint="Amplitude of each track")


def grouped(clips: Iterable[tuple[int, Clip]], amplitude: float) -> tuple[Input, ...]:
    """Return a track for each place that clips are for, in the order in which places come up."""
    of_place: dict[int, list[Clip]] = {}
    for place, clip in clips:
        of_place.setdefault(place, []).append(clip)
    return tuple(
        Input(location=place, clips=tuple(of), amplitude=amplitude)
        for place, of in of_place.items()
    )


def in_ms(time_s: float) -> str:
    """A time in words: "79.3 ms".

    >>> in_ms(0.0793)
    '79.3 ms'
    """
    return f"{1e3 * time_s:.4g} ms"


def beside(spacing_s: float, duration_s: float) -> str:
    """What lies between two that follow each other: an overlap, a pause, or nothing."""
    if abs(gap_s := spacing_s - duration_s) < 1e-9:
        return "one right after the other"
    return f"{in_ms(abs(gap_s))} {'apart' if gap_s > 0 else 'overlap'}"
