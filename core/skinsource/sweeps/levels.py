"""How strong the stimuli of a sweep are: as drawn, as predicted, or as people matched them."""

from dataclasses import replace
from typing import Literal, get_args

import numpy as np

from skinsource.arrays import Floats
from skinsource.design import Design, Input
from skinsource.errors import InvalidInputError
from skinsource.matching import Strengths
from skinsource.perception import sensation_levels_db
from skinsource.quoting import quoted

Level = Literal["drive", "loudest_100ms", "above_threshold", "matched"]
LEVELS: tuple[Level, ...] = get_args(Level)
#: Those that are predicted, and brought to so many decibels.
PREDICTED: tuple[Level, ...] = ("loudest_100ms", "above_threshold")
# A level below it is that of silence.
_SILENCE_DB = -290.0


def equally_strong(design: Design, strengths: Strengths) -> Design:
    """The design with the drive of each input as people matched it.

    An amplitude then means how strong it feels: that of a reference of this amplitude.

    Raises
    ------
    InvalidInputError
        An input plays no single frequency, or its frequency or place was not matched.
    """
    inputs = (
        one if one.muted else _equally_strong(number, one, strengths)
        for number, one in enumerate(design.inputs, start=1)
    )
    return replace(design, inputs=tuple(inputs))


def above_threshold(acceleration: Floats, sample_rate_hz: float, scaling: str) -> float:
    """How far the most sensitive channel at the loudest output is above threshold, as a ratio.

    Parameters
    ----------
    acceleration : (n_outputs, n_axes, n_times)
        m/s².
    scaling
        Of the design.

    Raises
    ------
    InvalidInputError
        Amplitudes are no accelerations, or nothing is known of the outputs of the limb.
    """
    if scaling != "probe":
        raise InvalidInputError(
            f"the scaling is {quoted(scaling)}, and levels above threshold need m/s². Choose the "
            "scaling Probe acceleration."
        )
    levels_db = sensation_levels_db(acceleration, sample_rate_hz)
    highest_db = max(float(one.max()) for one in levels_db.values())
    return float(10.0 ** (highest_db / 20.0)) if highest_db > _SILENCE_DB else 0.0


def _equally_strong(number: int, one: Input, strengths: Strengths) -> Input:
    found = {getattr(clip.waveform, "frequency_hz", None) for clip in one.clips if not clip.muted}
    frequencies_hz = [each for each in found if isinstance(each, float)]
    if not found:
        return one
    if len(found) != 1 or len(frequencies_hz) != 1:
        raise InvalidInputError(
            f"input {number} does not play one frequency, expected waveforms of one frequency_hz: "
            "only such vibrations were matched"
        )
    level_db = strengths.level_db(frequencies_hz[0], one.location)
    return replace(one, amplitude=one.amplitude * float(np.power(10.0, level_db / 20.0)))
