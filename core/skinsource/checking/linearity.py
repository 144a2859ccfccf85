"""What a linear model rests on, seen in designs that are kept: proportion, and sums."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import scipy

from skinsource.analysis.bands import band_rms
from skinsource.arrays import Floats
from skinsource.comparing.snapshot import alike, louder
from skinsource.design import Design, Input, audible_inputs
from skinsource.errors import InvalidInputError
from skinsource.limb import Band
from skinsource.validation import superposition_correlation
from skinsource.validation.linearity import straight_lines

#: Fewer strengths make no line that could be bent.
LEAST_STRENGTHS = 3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Proportion:
    """The same stimulus at several strengths.

    Attributes
    ----------
    strengths : (n_strengths,)
        Amplitudes of the first input, rising.
    divided : (n_strengths, n_channels, n_times)
        Responses divided by them.
    apart
        How far these are from each other at most, as a part of their peak; NaN: all are silent.
    rms, line : (n_strengths, n_channels)
        Of the responses, and the straight line through them by least squares.
    frequency_hz : (n_bins,)
        Middles of bands of 2 Hz.
    band_rms, band_line : (n_strengths, n_channels, n_bins)
        Of what the responses hold there, and the straight line through them.
    adjusted_r2 : (n_channels, n_bins)
        Of these lines; NaN: nothing is heard.
    """

    strengths: Floats
    divided: Floats
    apart: float
    rms: Floats
    line: Floats
    frequency_hz: Floats
    band_rms: Floats
    band_line: Floats
    adjusted_r2: Floats


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Straightness:
    """How straight outputs are over the strengths of an input, those that nobody selected too.

    Attributes
    ----------
    frequency_hz : (n_bins,)
        Middles of bands of 2 Hz.
    adjusted_r2 : (n_outputs, n_axes, n_bins)
        Of straight lines by least squares; NaN: nothing is heard.
    """

    frequency_hz: Floats
    adjusted_r2: Floats


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Superposition:
    """Inputs alone, and all of them together.

    Attributes
    ----------
    separate, joint : (n_channels, n_times)
        Sum of the responses to each, and the response to all.
    apart
        How far these are from each other at most, as a part of the peak; NaN: all are silent.
    correlation : (n_channels,)
        Pearson's r of the two; NaN where a channel is silent.
    """

    separate: Floats
    joint: Floats
    apart: float
    correlation: Floats


def strengths_of(designs: Sequence[Design]) -> tuple[float, ...]:
    """Amplitudes of the first input of designs that differ in strength alone; none: they do not.

    Three different ones or more; words about them, markers and loops do not matter.
    """
    plain = [_plain(one) for one in designs]
    if not plain or not all(one.inputs and one.inputs[0].amplitude > 0.0 for one in plain):
        return ()
    found = tuple(one.inputs[0].amplitude for one in plain)
    try:
        scaled = [louder(plain[0], one / found[0]) for one in found]
    except InvalidInputError:
        return ()
    if not all(alike(one, other) for one, other in zip(scaled, plain, strict=True)):
        return ()
    ordered = sorted(found)
    different = 1 + sum(
        not math.isclose(low, high, rel_tol=1e-9) for low, high in pairwise(ordered)
    )
    return found if different >= LEAST_STRENGTHS else ()


def joint_of(designs: Sequence[Design]) -> int | None:
    """Which of the designs plays what all the others play, each once; None: none does."""
    if len(designs) < 3:
        return None
    plain = [_plain(one) for one in designs]
    # Ids that a design gave tell the same inputs apart.
    played = [[_bare(one) for one in each.inputs] for each in plain]
    if not all(played) or len({replace(one, inputs=()) for one in plain}) > 1:
        return None
    for k, whole in enumerate(played):
        others = [one for n, each in enumerate(played) if n != k for one in each]
        if _are_the_same(others, whole):
            return k
    return None


def proportion(
    strengths: Sequence[float], responses: Floats, sample_rate_hz: float, band_hz: Band | None
) -> Proportion:
    """Hold responses, (n_strengths, n_channels, n_times), against the strengths of the input."""
    order = np.argsort(strengths, kind="stable")
    x, y = np.asarray(strengths, float)[order], responses[order]
    divided = y / x[:, None, None]
    rms = np.sqrt(np.mean(np.square(y), axis=-1))
    slope, offset, _ = straight_lines(x[:, None], rms)
    transforms = scipy.fft.rfft(y)
    frequency_hz, in_bands = band_rms(transforms, y.shape[-1], sample_rate_hz, band_hz)
    levels = x[:, None, None]
    of_band, above, adjusted_r2 = straight_lines(levels, in_bands)
    return Proportion(
        strengths=x,
        divided=divided,
        apart=_apart(divided),
        rms=rms,
        line=offset + slope * x[:, None],
        frequency_hz=frequency_hz,
        band_rms=in_bands,
        band_line=above + of_band * levels,
        adjusted_r2=adjusted_r2,
    )


def straightness(
    strengths: Sequence[float], in_bands: Sequence[tuple[Floats, Floats]]
) -> Straightness:
    """Fit lines over strengths to the quantity ``output_band_rms`` of each of them."""
    frequency_hz = in_bands[0][0]
    y = np.stack([rms for _, rms in in_bands])
    x = np.asarray(strengths, float).reshape(-1, 1, 1, 1)
    return Straightness(frequency_hz=frequency_hz, adjusted_r2=straight_lines(x, y)[2])


def superposition(parts: Sequence[Floats], joint: Floats) -> Superposition:
    """Hold the sum of responses, (n_channels, n_times) each, against the one to all together.

    None is longer than that one.
    """
    found = np.zeros((len(parts), *joint.shape))
    for whole, part in zip(found, parts, strict=True):
        # A part may end sooner: it is silent after that.
        whole[:, : part.shape[-1]] = part
    separate = found.sum(axis=0)
    return Superposition(
        separate=separate,
        joint=joint,
        apart=_apart(np.stack((separate, joint))),
        correlation=superposition_correlation(found, joint),
    )


def _plain(design: Design) -> Design:
    """What is played and where, whatever it is called and however it looks."""
    inputs = tuple(_bare(one) for one in audible_inputs(design.inputs))
    return replace(
        design,
        title="",
        author="",
        notes="",
        licence="",
        markers=(),
        loop_s=None,
        inputs=inputs,
    )


def _bare(one: Input) -> Input:
    clips = tuple(replace(each, id=0) for each in one.clips)
    return replace(one, id=0, colour=0, solo=False, clips=clips)


def _are_the_same(some: Sequence[Input], others: Sequence[Input]) -> bool:
    """Whether both are the same inputs, in any order, each as often."""
    left = list(others)
    for one in some:
        if one not in left:
            return False
        left.remove(one)
    return not left


def _apart(curves: Floats) -> float:
    peak = float(np.abs(curves).max())
    return float(np.ptp(curves, axis=0).max()) / peak if peak > 0.0 else math.nan
