"""What figures show of a design."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from skinsource.arrays import Floats
from skinsource.clips import Clip
from skinsource.design import Design
from skinsource.evaluation import evaluate
from skinsource.limb import AXES, Axes, axis_numbers
from skinsource.own_limbs import facts_of
from skinsource.plot.levels import Levels, levels_of
from skinsource.projection import magnitude
from skinsource.view import View
from skinsource.waveforms import Tone


def field_of(design: Design) -> tuple[Floats, Floats]:
    """Times, (n_times,), in s, and acceleration, (n_outputs, n_axes, n_times), in m/s²."""
    limb = evaluate(design, "limb_data")["limb_data"]
    view = View(axes="xyz", outputs=tuple(range(1, limb.n_outputs + 1)))
    found = evaluate(design, "response_time_s", "axis_traces", view=view)
    return found["response_time_s"], found["axis_traces"]


def axes_of_sensors(design: Design) -> tuple[Axes, ...]:
    """Those along which the limb of a design was measured, one by one."""
    measured = facts_of(design.limb).axes
    return tuple(axis for axis in AXES if len(axis) == 1 and axis in measured)


def normal_of(design: Design, field: Floats) -> Floats:
    """Of the field of a design, what is normal to the skin, z, (n_outputs, n_times)."""
    (normal,) = axis_numbers("z", facts_of(design.limb).axes)
    return field[:, normal]


def frequency_of(clip: Clip) -> float:
    """Frequency of the tone that a clip plays, Hz."""
    if not isinstance(clip.waveform, Tone):
        raise TypeError(f"{clip.waveform} is no tone")
    return clip.waveform.frequency_hz


def frames(design: Design, instants: list[int]) -> Floats:
    """Length of the acceleration at some samples, (n_instants, n_outputs), in m/s²."""
    _, field = field_of(design)
    return magnitude(field)[:, instants].T


def loudest_of(levels: Sequence[Levels], *, together: bool) -> list[float]:
    """Level of the loudest output of each, or of all of them together, in dB."""
    loudest = [float(one.values.max()) for one in levels]
    return [max(loudest)] * len(levels) if together else loudest


def with_values(design: Design, values: Floats) -> Levels:
    """A map of any values at the outputs, with the places that the design drives.

    Nothing is hatched: what noise the whole record has says little of an instant.
    """
    return replace(levels_of(design, None, None), values=np.asarray(values), noisy=())
