"""From a design to the channels that actuators get."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Literal

import numpy as np

from skinsource.arguments import one_of, whole_number
from skinsource.arrays import Floats
from skinsource.catalogue import load_limb
from skinsource.chain import Part, drive_played, drive_unit, placed_chain
from skinsource.counting import counted
from skinsource.design import Design, Input, audible_inputs
from skinsource.effects import played
from skinsource.errors import InvalidInputError
from skinsource.job import Progress, Stop, never, silent, stop_if
from skinsource.limb import Limb, check_input_location
from skinsource.locations import input_words
from skinsource.quoting import quoted
from skinsource.resampling import MAX_RATE_HZ, by_ratio
from skinsource.stimulus.channel import Channel
from skinsource.stimulus.stimulus import Stimulus
from skinsource.stimulus.times import lead_in_samples

#: Something that is done to a stimulus at the rate of the device: an equaliser, for instance.
Stage = Callable[[Stimulus], Stimulus]

#: Samples of all channels together: one gigabyte.
MOST_SAMPLES = 2**27
_PER = ("place", "input")


def stimulus_of(
    design: Design,
    sample_rate_hz: int | None = None,
    *,
    per: Literal["place", "input"] = "place",
    inputs: Iterable[int] | None = None,
    clips: Iterable[int] | None = None,
    stages: Sequence[Stage] = (),
    limb: Limb | None = None,
    lead_in_s: float = 0.0,
    progress: Progress = silent,
    stop: Stop = never,
) -> Stimulus:
    """Return what the actuators get to play a design.

    Each channel is amplitude x gain x waveform, at the rate of the limb, where the prediction is
    made from the same samples; another rate is reached by `skinsource.resample`, so that what is
    played is what is predicted.  Sample 0 is time 0 of the design, unless there is a lead-in.

    Parameters
    ----------
    design, sample_rate_hz
        Inputs that are not heard are left out; whole hertz, None: the rate of the limb.
    per
        ``"place"``: one channel for each place in use, in the order of first use, so that inputs
        at one place add up.  ``"input"``: one channel for each input.
    inputs, clips
        Ids of the inputs, or of the clips, that take part; None: all of them.
    stages
        What is done at the end, at ``sample_rate_hz``, one after the other.
    limb
        Of the design, where it is open already.
    lead_in_s
        How long before time 0 it begins: silence, but for what rings there at another rate.
    progress, stop
        As of a job: told how many channels have their rate; `Stopped` is raised.

    Raises
    ------
    InvalidInputError
        A place, an id, a rate or a sample that cannot be, or more samples than can be held.
    DatasetMissingError
        The limb is a measured one, and the measured dataset is not installed.

    Examples
    --------
    >>> import skinsource as ss
    >>> found = ss.stimulus_of(ss.Design(limb="synthetic-1", inputs=(ss.track(7),)), 48_000)
    >>> found.channels[0].title, found.samples.shape
    ('Digit II, pad', (1, 9600))
    """
    heard = _taking_part(design, inputs, clips)
    one_of("per", per, _PER)
    found = _made(design, limb, heard, per, sample_rate_hz, lead_in_s, (progress, stop))
    for stage in stages:
        stop_if(stop)
        found = stage(found)
    return found


def _made(
    design: Design,
    limb: Limb | None,
    heard: tuple[Input, ...],
    per: str,
    sample_rate_hz: int | None,
    lead_in_s: float,
    job: tuple[Progress, Stop],
) -> Stimulus:
    """What ``heard`` plays."""
    if sample_rate_hz is not None:
        sample_rate_hz = whole_number("sample_rate_hz", sample_rate_hz, 1, MAX_RATE_HZ)
    limb = load_limb(design.limb) if limb is None else limb
    for one in heard:
        check_input_location(one.location, limb.n_inputs)
    own_rate_hz = limb.sample_rate_hz
    rate_hz = own_rate_hz if sample_rate_hz is None else float(sample_rate_hz)
    channels = _channels(heard, per, design.limb)
    lead = lead_in_samples(lead_in_s, rate_hz)
    return Stimulus(
        channels=channels,
        samples=_sampled(heard, channels, own_rate_hz, rate_hz, lead, *job),
        sample_rate_hz=rate_hz,
        start_s=-lead / rate_hz if lead else 0.0,
        limb=design.limb,
        scaling=design.scaling,
        own_rate_hz=own_rate_hz,
        limb_band_hz=limb.band_hz,
        unit=drive_unit(design, limb),
    )


def _taking_part(
    design: Design, inputs: Iterable[int] | None, clips: Iterable[int] | None
) -> tuple[Input, ...]:
    """Inputs that are heard, with those of their clips that take part."""
    if not isinstance(design, Design):
        raise InvalidInputError(f"design is {quoted(design)}, expected a Design")
    heard = audible_inputs(design.inputs)
    if inputs is not None:
        wanted = {design.input(id).id for id in inputs}
        heard = tuple(one for one in heard if one.id in wanted)
    if clips is None:
        return heard
    chosen = {design.clip(id).id for id in clips}
    left = (
        replace(one, clips=tuple(clip for clip in one.clips if clip.id in chosen)) for one in heard
    )
    return tuple(one for one in left if one.clips)


def _channels(heard: tuple[Input, ...], per: str, limb: str) -> tuple[Channel, ...]:
    together: dict[int, list[Input]] = {}
    for one in heard:
        together.setdefault(one.location if per == "place" else one.id, []).append(one)
    return tuple(
        Channel(
            number=number,
            place=group[0].location,
            title=input_words(group[0].location, limb).name,
            inputs=tuple(one.id for one in group),
        )
        for number, group in enumerate(together.values(), start=1)
    )


def _sampled(
    heard: tuple[Input, ...],
    channels: tuple[Channel, ...],
    own_rate_hz: float,
    rate_hz: float,
    lead: int,
    progress: Progress,
    stop: Stop,
) -> Floats:
    """Samples at ``rate_hz`` from ``lead`` before time 0, (n_channels, n_times); at least one."""
    ratio = Fraction(rate_hz) / Fraction(own_rate_hz)
    rows = {id: row for row, one in enumerate(channels) for id in one.inputs}
    pieces: list[tuple[int, int, float, Floats]] = []

    def drawn(part: Part) -> Floats:
        return played(part.waveform, part.effects, own_rate_hz, part.shift_s)

    for one in heard:
        stop_if(stop)
        start, chain = placed_chain(one.clips, one.gain_curve, own_rate_hz)
        drive = drive_played(chain, own_rate_hz, one.location, drawn)
        pieces.append((rows[one.id], start, one.amplitude * drive.factor, drive.samples))
    n = max([1, *(start + samples.size for _, start, _, samples in pieces)])
    # Samples of both rates meet at time 0: what comes before is whole numbers of either.
    steps = -(-lead // ratio.numerator)
    before, surplus = steps * ratio.denominator, steps * ratio.numerator - lead
    n += before
    _refuse_too_long(len(channels), -(-n * ratio.numerator // ratio.denominator), rate_hz)
    total = np.zeros((len(channels), n))
    for row, start, factor, samples in pieces:
        begin = before + start
        total[row, begin : begin + samples.size] += factor * samples
    stop_if(stop)
    if ratio == 1:
        return total
    found = np.empty((len(channels), -(-n * ratio.numerator // ratio.denominator)))
    for row, samples in enumerate(total):
        # A minute at the rate of a sound card takes a while.
        stop_if(stop)
        progress(row, len(channels), "Computing")
        found[row] = by_ratio(samples, ratio, min(own_rate_hz, rate_hz))
    return found[:, surplus:]


def _refuse_too_long(n_channels: int, n_times: int, rate_hz: float) -> None:
    if n_channels * n_times > MOST_SAMPLES:
        longest_s = MOST_SAMPLES / n_channels / rate_hz
        raise InvalidInputError(
            f"The stimulus lasts {n_times / rate_hz:.1f} s, expected at most {longest_s:.1f} s for "
            f"{counted(n_channels, 'channel')} at {rate_hz:g} Hz. "
            "Choose a lower rate, mute inputs, or make the design shorter."
        )
