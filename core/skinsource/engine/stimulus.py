"""Stimuli: sampled channels for actuators, made from a design, and changed before an export.

Functions return a changed stimulus: other order, fades, scale, part of time, lead-in, sync channel,
and polarity, volts and delays of the channels of a rig.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import ceil, floor
from typing import Any, Literal

import numpy as np

from skinsource.actuators.actuation import Actuation, names
from skinsource.actuators.equalising import Equaliser, equalised, followed_band
from skinsource.actuators.rigs import Rig, RigChannel, full_scale_volts, known_model, wired_channel
from skinsource.base.arguments import checking, integer, one_of, real_number
from skinsource.base.conventions import BAND_HZ, Band, Floats, check_input_location
from skinsource.base.errors import InvalidInputError, counted, quoted
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.design.amplitudes import ARBITRARY_UNIT, drive_unit
from skinsource.design.design import Design, Input, audible_inputs
from skinsource.design.effects.playing import played
from skinsource.design.signal_path import Part, drive_played, placed_signal_path
from skinsource.limbs.catalog import limb_of
from skinsource.limbs.limb import Limb
from skinsource.limbs.locations import input_name
from skinsource.limbs.scaling import Scaling
from skinsource.signals.resampling import MAX_RATE_HZ, PASSED_SHARE, by_ratio
from skinsource.signals.sampling import NEAR, band_limited_delay


@dataclass(frozen=True, slots=True, kw_only=True)
class Channel:
    """Channel for one actuator, or for another device that is wired to an output.

    Attributes
    ----------
    number
        Number of the channel, from 1.
    place
        Input location of the actuator; None: it drives no actuator (sync, or left silent).
    inputs
        Ids of the inputs of the design that it plays.
    loss_db
        How much of its energy is lost at the sample rate.
    """

    number: int
    place: int | None
    title: str
    inputs: tuple[int, ...] = ()
    loss_db: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Stimulus:
    """Sampled channels.

    Attributes
    ----------
    channels
        Descriptions of the channels; none where no input is audible.
    samples : (n_channels, n_times)
        Amplitude times gain times waveform, read-only.
    limb
        Name of the limb of the design.
    scaling
        Meaning of an amplitude of 1 in the design.
    start_s
        Time of the first sample in the design.
    own_rate_hz
        Rate at which the design was sampled: samples hold no frequency above half of it.
    unit
        Unit of channels that have a place, see `skinsource.design.amplitudes.drive_unit`.
    limb_band_hz
        Frequencies at which the limb was measured; None where they are not known.
    """

    channels: tuple[Channel, ...]
    samples: Floats
    sample_rate_hz: float
    limb: str
    scaling: Scaling
    start_s: float = 0.0
    own_rate_hz: float
    unit: str
    limb_band_hz: Band | None = BAND_HZ

    def __post_init__(self) -> None:
        if self.samples.ndim != 2 or len(self.channels) != self.samples.shape[0]:
            raise ValueError(
                f"samples have the shape {self.samples.shape}, expected "
                f"({len(self.channels)} channels, n_times)"
            )
        samples = self.samples.view()
        samples.flags.writeable = False
        object.__setattr__(self, "samples", samples)

    @property
    def n_times(self) -> int:
        """Samples of each channel."""
        return self.samples.shape[1]

    @property
    def duration_s(self) -> float:
        """Duration."""
        return self.n_times / self.sample_rate_hz

    @property
    def band_hz(self) -> Band:
        """Lowest and highest frequency at which samples agree with the prediction."""
        lower_hz = min(self.sample_rate_hz, self.own_rate_hz)
        low_hz, high_hz = self.limb_band_hz or (0.0, np.inf)
        return low_hz, min(high_hz, PASSED_SHARE * 0.5 * lower_hz)

    @property
    def driving(self) -> tuple[int, ...]:
        """Rows of the channels that drive an actuator."""
        return tuple(row for row, channel in enumerate(self.channels) if channel.place is not None)

    def with_samples(self, samples: Floats, **changes: object) -> Stimulus:
        """Return a copy that holds other samples."""
        return replace(self, samples=samples, **changes)  # type: ignore[arg-type]


def stimulus_of_outputs(samples: Mapping[int, Floats], sample_rate_hz: int) -> Stimulus:
    """Return samples that are parts of full scale, (n_times,) each, by output, from 1, as channels.

    `skinsource.Player` plays them on these outputs, such as those of an exported file.

    Examples
    --------
    >>> import numpy as np
    >>> from skinsource.engine.stimulus import stimulus_of_outputs
    >>> stimulus_of_outputs({3: np.zeros(480)}, 48_000).channels[0].title
    'output 3'
    """
    channels = [Channel(number=n, place=n, title=f"output {n}") for n in samples]
    return Stimulus(
        channels=tuple(channels),
        samples=np.array(list(samples.values())),
        sample_rate_hz=sample_rate_hz,
        limb="",
        scaling="probe",
        own_rate_hz=sample_rate_hz,
        unit=FULL_SCALE_UNIT,
        limb_band_hz=None,
    )


def numbered(channels: Iterable[Channel]) -> tuple[Channel, ...]:
    """Number ``channels`` from 1 in their order."""
    return tuple(
        replace(channel, number=number) for number, channel in enumerate(channels, start=1)
    )


def peaks(samples: Floats) -> Floats:
    """Return the largest absolute sample of each channel, (n_channels,), without copying them."""
    if not samples.shape[1]:
        return np.zeros(samples.shape[0])
    return np.maximum(samples.max(axis=1), -samples.min(axis=1))


#: Outputs of the largest device that is supported.
MOST_OUTPUTS = 1024


def in_order(stimulus: Stimulus, outputs: Sequence[int]) -> Stimulus:
    """Return the channels in the order of outputs.

    Parameters
    ----------
    stimulus
        Channels 1, 2, 3, …
    outputs
        Number of the channel for each output of the device; 0 for an output that stays silent.

    Raises
    ------
    InvalidInputError
        No channel has such a number, or a channel occurs twice or not at all.
    """
    n_channels = len(stimulus.channels)
    numbers = [integer("Channel map", number, 0, n_channels) for number in outputs]
    used = [number for number in numbers if number]
    if len(numbers) > MOST_OUTPUTS or sorted(used) != list(range(1, n_channels + 1)):
        raise InvalidInputError(
            f"Channel map is {quoted(list(outputs))}, expected each channel from 1 to {n_channels} "
            f"once, and 0 for outputs that stay silent, at most {MOST_OUTPUTS} altogether. To "
            "leave a channel out, choose the tracks instead."
        )
    silent = Channel(number=0, place=None, title="Silent")
    samples = np.zeros((len(numbers), stimulus.n_times))
    channels = []
    for row, number in enumerate(numbers):
        channels.append(stimulus.channels[number - 1] if number else silent)
        if number:
            samples[row] = stimulus.samples[number - 1]
    return stimulus.with_samples(samples, channels=numbered(channels))


def faded(stimulus: Stimulus, fade_in_s: float = 0.0, fade_out_s: float = 0.0) -> Stimulus:
    """Fade all channels that drive an actuator in and out, along half a cosine.

    The first and the last sample become 0.

    Parameters
    ----------
    stimulus
        Stimulus without fades.
    fade_in_s, fade_out_s
        Durations of the fades; 0 for none.

    Raises
    ------
    InvalidInputError
        A fade is longer than the stimulus.
    """
    factor = np.ones(stimulus.n_times)
    duration_s = stimulus.duration_s
    for name, length_s, part in (
        ("fade_in_s", fade_in_s, factor),
        ("fade_out_s", fade_out_s, factor[::-1]),
    ):
        given_s = real_number(
            name,
            length_s,
            f"a time from 0 to {duration_s:g} s, the length of the stimulus",
            least=0.0,
            most=duration_s,
        )
        n = round(given_s * stimulus.sample_rate_hz)
        # From 0 at the first sample to 1 at sample n.
        part[:n] *= 0.5 - 0.5 * np.cos(np.pi * np.arange(n) / max(n, 1))
    if np.all(factor == 1.0):
        return stimulus
    samples = stimulus.samples.copy()
    samples[list(stimulus.driving)] *= factor
    return stimulus.with_samples(samples)


def full_scale_factor(stimulus: Stimulus) -> float:
    """Return the factor that brings the largest sample to 1; 1 where all channels are silent.

    Channels that drive no actuator do not count.
    """
    rows = list(stimulus.driving)
    peak = float(peaks(stimulus.samples)[rows].max(initial=0.0)) if rows else 0.0
    if peak == 0.0:
        return 1.0
    factor = 1.0 / peak
    # The factor is rounded down, so that the largest sample does not exceed 1.
    return float(np.nextafter(factor, 0.0)) if peak * factor > 1.0 else factor


def scaled(stimulus: Stimulus, factor: float) -> Stimulus:
    """Multiply the channels that drive an actuator with ``factor``."""
    if factor == 1.0:
        return stimulus
    factors = np.ones((len(stimulus.channels), 1))
    factors[list(stimulus.driving)] = factor
    return stimulus.with_samples(stimulus.samples * factors)


#: Longest silence before or after a stimulus.
LONGEST_LEAD_IN_S = 60.0


def part_of_time(stimulus: Stimulus, from_s: float, to_s: float) -> Stimulus:
    """Return the samples from one time of the design up to, not including, another.

    Both ends are cut without a fade, see `faded`.  Where the stimulus ends earlier, silence
    follows.

    Raises
    ------
    InvalidInputError
        The times are not in order, or no sample lies between them.
    """
    begin_s = real_number("from_s", from_s, "a time of the design from 0 on", least=0.0)
    end_s = real_number("to_s", to_s, f"a time after from_s, {begin_s:g} s", least=begin_s)
    first, end = (
        ceil((time_s - stimulus.start_s) * stimulus.sample_rate_hz - NEAR)
        for time_s in (begin_s, end_s)
    )
    first = max(first, 0)
    if end <= first:
        raise InvalidInputError(
            f"to_s is {end_s:g} and from_s is {begin_s:g}: no sample lies between them, expected "
            "at least one. Take a longer part."
        )
    samples = np.zeros((len(stimulus.channels), end - first))
    inside = stimulus.samples[:, first:end]
    samples[:, : inside.shape[1]] = inside
    return stimulus.with_samples(
        samples, start_s=stimulus.start_s + first / stimulus.sample_rate_hz
    )


def with_silence(stimulus: Stimulus, lead_in_s: float, tail_s: float = 0.0) -> Stimulus:
    """Return a stimulus with silence before and after it, rounded up to whole samples."""
    lead = silent_samples("lead_in_s", lead_in_s, stimulus.sample_rate_hz)
    tail = silent_samples("tail_s", tail_s, stimulus.sample_rate_hz)
    if not lead and not tail:
        return stimulus
    samples = np.pad(stimulus.samples, ((0, 0), (lead, tail)))
    return stimulus.with_samples(samples, start_s=stimulus.start_s - lead / stimulus.sample_rate_hz)


def silent_samples(name: str, length_s: float, sample_rate_hz: float) -> int:
    """Return the number of samples of a silence, rounded up.

    Raises
    ------
    InvalidInputError
        It is negative, or longer than `LONGEST_LEAD_IN_S`.
    """
    length_s = real_number(
        name,
        length_s,
        f"a time from 0 to {LONGEST_LEAD_IN_S:g} s",
        least=0.0,
        most=LONGEST_LEAD_IN_S,
    )
    return ceil(length_s * sample_rate_hz - NEAR)


#: A change of a stimulus at the rate of the device, for example by an equaliser.
Stage = Callable[[Stimulus], Stimulus]

#: Samples of all channels together: one gigabyte.
MOST_SAMPLES = 2**27


@checking
def stimulus_of(
    design: Design,
    sample_rate_hz: int | None = None,
    *,
    per: Literal["place", "input"] = "place",
    inputs: Iterable[int] | None = None,
    clips: Iterable[int] | None = None,
    stages: Sequence[Stage] = (),
    limb: Limb | str | None = None,
    lead_in_s: float = 0.0,
    progress: Progress = silent,
    stop: Stop = never,
) -> Stimulus:
    """Return the samples that actuators play for a design.

    Each channel is amplitude x gain x waveform.  It is sampled at the rate of the limb, as for the
    prediction, and converted to another rate by `skinsource.resample`, so that what is played is
    what is predicted.  Sample 0 is time 0 of the design, unless there is a lead-in.

    Parameters
    ----------
    design
        Inputs that are not audible are left out.
    sample_rate_hz
        A whole number of hertz; None for the rate of the limb.
    per
        ``"place"``: one channel for each location in use, in the order of the first inputs there,
        audible or not, so that muting reorders none; inputs at one location add up.  ``"input"``:
        one channel for each input.
    inputs, clips
        Ids of the inputs, or of the clips, that are played; None for all of them.
    stages
        Changes at ``sample_rate_hz``, applied one after the other at the end.
    limb
        Limb of the design, where it is open already.
    lead_in_s
        How long before time 0 the samples begin: silence, with the ringing of a rate conversion.
    progress, stop
        ``progress`` is called after each converted channel; once ``stop`` returns True, `Stopped`
        is raised.

    Raises
    ------
    InvalidInputError
        A location, an id, a rate or a sample is not valid, or there are too many samples.
    DatasetMissingError
        The limb is a measured one, and the measured dataset is not installed.

    Examples
    --------
    >>> import skinsource as ss
    >>> stimulus = ss.stimulus_of(ss.Design(limb="synthetic-1", inputs=(ss.track(7),)), 48_000)
    >>> stimulus.channels[0].title, stimulus.samples.shape
    ('Digit II, pad', (1, 9600))
    """
    _, stimulus = stimuli_of(
        design,
        sample_rate_hz,
        per=per,
        inputs=inputs,
        clips=clips,
        limb=limb,
        lead_in_s=lead_in_s,
        tail_s=0.0,
        progress=progress,
        stop=stop,
    )
    for stage in stages:
        stop_if(stop)
        stimulus = stage(stimulus)
    return stimulus


def stimuli_of(
    design: Design,
    sample_rate_hz: int | None,
    *,
    per: Literal["place", "input"],
    inputs: Iterable[int] | None,
    clips: Iterable[int] | None,
    limb: Limb | str | None = None,
    lead_in_s: float,
    tail_s: float,
    progress: Progress,
    stop: Stop,
) -> tuple[Stimulus, Stimulus]:
    """Return the stimulus at the rate of the limb from time 0 on, and the one of `stimulus_of`.

    Waveforms are sampled once.  Parameters and errors are those of `stimulus_of`; ``tail_s`` is how
    long the samples go on after the last clip.
    """
    tracks = _playing_tracks(design, inputs, clips)
    one_of("per", per, ("place", "input"))
    if sample_rate_hz is not None:
        sample_rate_hz = integer("sample_rate_hz", sample_rate_hz, 1, MAX_RATE_HZ)
    limb = limb_of(design.limb if limb is None else limb)
    for track in tracks:
        check_input_location(track.location, limb.n_inputs)
    own_rate_hz = limb.sample_rate_hz
    rate_hz = own_rate_hz if sample_rate_hz is None else float(sample_rate_hz)
    channels = _channels(design, tracks, per)
    lead = silent_samples("lead_in_s", lead_in_s, rate_hz)
    tail = silent_samples("tail_s", tail_s, own_rate_hz)
    own_samples, samples = _samples_of(
        tracks, channels, own_rate_hz, rate_hz, lead, tail, progress, stop
    )
    own = Stimulus(
        channels=channels,
        samples=own_samples,
        sample_rate_hz=own_rate_hz,
        limb=design.limb,
        scaling=design.scaling,
        own_rate_hz=own_rate_hz,
        limb_band_hz=limb.band_hz,
        unit=drive_unit(design, limb),
    )
    start_s = -lead / rate_hz if lead else 0.0
    return own, replace(own, samples=samples, sample_rate_hz=rate_hz, start_s=start_s)


def _playing_tracks(
    design: Design, inputs: Iterable[int] | None, clips: Iterable[int] | None
) -> tuple[Input, ...]:
    """Return audible inputs among ``inputs``, with those of their clips that are in ``clips``."""
    tracks = audible_inputs(design.inputs)
    if inputs is not None:
        track_ids = {design.input(id).id for id in inputs}
        tracks = tuple(track for track in tracks if track.id in track_ids)
    if clips is None:
        return tracks
    chosen = {design.clip(id).id for id in clips}
    with_chosen_clips = (
        replace(track, clips=tuple(clip for clip in track.clips if clip.id in chosen))
        for track in tracks
    )
    return tuple(track for track in with_chosen_clips if track.clips)


def _channels(design: Design, tracks: tuple[Input, ...], per: str) -> tuple[Channel, ...]:
    groups: dict[int, list[Input]] = {
        track.location if per == "place" else track.id: [] for track in design.inputs
    }
    for track in tracks:
        groups[track.location if per == "place" else track.id].append(track)
    return tuple(
        Channel(
            number=number,
            place=group[0].location,
            title=input_name(group[0].location, design.limb).name,
            inputs=tuple(track.id for track in group),
        )
        for number, group in enumerate(filter(None, groups.values()), start=1)
    )


def _samples_of(
    tracks: tuple[Input, ...],
    channels: tuple[Channel, ...],
    own_rate_hz: float,
    rate_hz: float,
    lead: int,
    tail: int,
    progress: Progress,
    stop: Stop,
) -> tuple[Floats, Floats]:
    """Return samples at the own rate from time 0 on, and at ``rate_hz`` from ``lead`` before it.

    Both go on for ``tail`` samples of the own rate.
    """
    ratio = Fraction(rate_hz) / Fraction(own_rate_hz)
    rows = {id: row for row, channel in enumerate(channels) for id in channel.inputs}
    pieces: list[tuple[int, int, float, Floats]] = []

    def drawn(part: Part) -> Floats:
        return played(part.waveform, part.effects, own_rate_hz, part.shift_s)

    for track in tracks:
        stop_if(stop)
        start, signal_path = placed_signal_path(track.clips, track.gain_curve, own_rate_hz)
        drive = drive_played(signal_path, own_rate_hz, track.location, drawn)
        pieces.append((rows[track.id], start, track.amplitude * drive.factor, drive.samples))
    n = max([1, *(start + samples.size for _, start, _, samples in pieces)])
    # Samples of both rates coincide at time 0, so that the lead is a whole number of both.
    steps = -(-lead // ratio.numerator)
    before, surplus = steps * ratio.denominator, steps * ratio.numerator - lead
    n += before + tail
    _check_length(len(channels), -(-n * ratio.numerator // ratio.denominator), rate_hz)
    total = np.zeros((len(channels), n))
    for row, start, factor, samples in pieces:
        begin = before + start
        total[row, begin : begin + samples.size] += factor * samples
    stop_if(stop)
    own = total[:, before:]
    if ratio == 1:
        return own, total
    converted = np.empty((len(channels), -(-n * ratio.numerator // ratio.denominator)))
    for row, samples in enumerate(total):
        # Converting a minute to the rate of a sound card takes a while.
        stop_if(stop)
        progress(row, len(channels), "Computing")
        converted[row] = by_ratio(samples, ratio, min(own_rate_hz, rate_hz))
    return own, converted[:, surplus:]


def _check_length(n_channels: int, n_times: int, rate_hz: float) -> None:
    if n_channels * n_times > MOST_SAMPLES:
        longest_s = MOST_SAMPLES / n_channels / rate_hz
        raise InvalidInputError(
            f"The stimulus lasts {n_times / rate_hz:.1f} s, expected at most {longest_s:.1f} s for "
            f"{counted(n_channels, 'channel')} at {rate_hz:g} Hz. "
            "Choose a lower rate, mute inputs, or make the design shorter."
        )


#: Long enough for ten samples of a recorder at 1 kHz.
PULSE_S = 0.01


def with_sync(stimulus: Stimulus, pulse_s: float = PULSE_S, at_s: float = 0.0) -> Stimulus:
    """Add a last channel with a pulse at full scale, for other devices.

    Where the stimulus begins after the pulse, or ends before its end, so does the pulse.  Samples
    of the channel are in parts of full scale, whatever the unit of other channels.

    Parameters
    ----------
    stimulus
        Stimulus with its lead-in, if it has one.
    pulse_s
        Length of the pulse.
    at_s
        Time of the design at which it begins.
    """
    length_s = real_number("pulse_s", pulse_s, "a time from 0.0001 to 10 s", least=1e-4, most=10.0)
    first = max(ceil((at_s - stimulus.start_s) * stimulus.sample_rate_hz - NEAR), 0)
    pulse = np.zeros((1, stimulus.n_times))
    pulse[0, first : first + max(round(length_s * stimulus.sample_rate_hz), 1)] = 1.0
    channel = Channel(number=len(stimulus.channels) + 1, place=None, title="Sync")
    return stimulus.with_samples(
        np.concatenate((stimulus.samples, pulse)), channels=(*stimulus.channels, channel)
    )


#: Unit of samples that are volts divided by the volts of their channel at full scale.
FULL_SCALE_UNIT = "full scale of the channel"
# Shorter delays, in samples, count as none.
_NO_DELAY = 1e-6


def for_rig(
    stimulus: Stimulus,
    rig: Rig,
    equaliser: Equaliser | None,
    *,
    scaled: bool = False,
    stop: Stop = never,
) -> Stimulus:
    """Return the samples that the channels of a rig must play.

    With an equaliser, or where drives are volts, samples are in parts of full scale of their own
    channel, polarity included; samples beyond 1 need more volts than the channel gives.  Otherwise
    only the polarity is applied.  Channels wait for the one with the longest delay, so that all
    actuators move at the same time.

    Parameters
    ----------
    scaled
        Whether full scale is chosen elsewhere: volts are then not divided.

    Raises
    ------
    InvalidInputError
        A location is not wired, drives are not accelerations, a drive leaves a velocity, or the rig
        does not know the volts at full scale or how an actuator moves.
    """
    samples, unit = np.array(stimulus.samples), stimulus.unit
    if equaliser is not None:
        samples = _equalised(
            stimulus, equaliser, lambda row: _actuator_of(channel_of(stimulus, row, rig)), stop
        )
    channels = {row: channel_of(stimulus, row, rig) for row in stimulus.driving}
    if equaliser is not None or (unit == "V" and not scaled):
        unit = FULL_SCALE_UNIT
        for row, channel in channels.items():
            samples[row] /= full_scale_volts(channel)
    else:
        inverted = [row for row, channel in channels.items() if channel.polarity == "inverted"]
        samples[inverted] *= -1.0
    return _aligned(stimulus.with_samples(samples, unit=unit), rig)


def through_actuators(
    stimulus: Stimulus, actuation: Actuation, equaliser: Equaliser, stop: Stop = never
) -> Stimulus:
    """Return the volts that make actuators follow the drives, without a rig.

    Raises
    ------
    InvalidInputError
        Drives are not accelerations, a drive leaves a velocity, or a location has no actuator.
    """
    places = {
        row: place
        for row, channel in enumerate(stimulus.channels)
        if (place := channel.place) is not None
    }
    samples = _equalised(stimulus, equaliser, lambda row: actuation.at(places[row]).model, stop)
    return stimulus.with_samples(samples, unit="V")


def _equalised(
    stimulus: Stimulus, equaliser: Equaliser, model_of: Callable[[int], Any], stop: Stop
) -> Floats:
    """Return samples with the volts for the actuators, by their rows."""
    _check_accelerations(stimulus)
    rate_hz, samples = stimulus.sample_rate_hz, np.array(stimulus.samples)
    # The frequencies at which actuators follow the drives.
    band = followed_band(stimulus.limb_band_hz, min(rate_hz, stimulus.own_rate_hz))
    for row in stimulus.driving:
        stop_if(stop)
        model = model_of(row)
        try:
            samples[row] = equalised(samples[row], rate_hz, model, equaliser, band_hz=band)
        except InvalidInputError as error:
            place = stimulus.channels[row].place
            raise InvalidInputError(f"Place {place}: {error}") from error
    return samples


def channel_of(stimulus: Stimulus, row: int, rig: Rig) -> RigChannel:
    """Return the channel of the rig for a row of the samples."""
    return wired_channel(rig, stimulus.channels[row].place)


def added_delays_s(stimulus: Stimulus, rig: Rig) -> dict[int, float]:
    """Return how long each row that drives an actuator waits for the slowest channel, by row."""
    delays_s = {row: channel_of(stimulus, row, rig).delay_s for row in stimulus.driving}
    longest = max(delays_s.values(), default=0.0)
    return {row: longest - delay_s for row, delay_s in delays_s.items()}


def _aligned(stimulus: Stimulus, rig: Rig) -> Stimulus:
    later = {
        row: delay_s * stimulus.sample_rate_hz
        for row, delay_s in added_delays_s(stimulus, rig).items()
    }
    longest = max(later.values(), default=0.0)
    if longest < _NO_DELAY:
        return stimulus
    delayed = np.zeros((len(stimulus.channels), stimulus.n_times + floor(longest) + 1))
    delayed[:, : stimulus.n_times] = stimulus.samples
    for row, samples in later.items():
        whole = floor(samples)
        moved = stimulus.samples[row]
        if _NO_DELAY < samples - whole < 1.0 - _NO_DELAY:
            moved = band_limited_delay(moved, samples - whole)
        else:
            whole = round(samples)
        delayed[row] = 0.0
        delayed[row, whole : whole + moved.size] = moved
    return stimulus.with_samples(delayed)


def _check_accelerations(stimulus: Stimulus) -> None:
    if stimulus.unit == "V":
        raise InvalidInputError(
            "The drives of this design are volts already: it is predicted through an actuator "
            "without an equaliser. Choose an equaliser there, or none here."
        )
    if stimulus.unit == ARBITRARY_UNIT:
        raise InvalidInputError(
            "An equaliser needs accelerations, but the drive of this limb has an unknown unit. "
            "Switch on 'Predict through the actuator': amplitudes are then accelerations of the "
            "contactor."
        )
    if stimulus.unit != "m/s²":
        raise InvalidInputError(
            "An equaliser needs accelerations, which the drives of this design are not: its "
            f"scaling is {stimulus.scaling}. Choose the scaling Probe acceleration."
        )


def _actuator_of(channel: RigChannel) -> Any:
    """Return how the actuator moves: its measured response, its model, or that of its name."""
    model = known_model(channel)
    if model is None:
        raise InvalidInputError(
            f"place {channel.place}: the rig has no response of the actuator "
            f"{quoted(channel.actuator)}. Measure it, or name one of {', '.join(names())}."
        )
    return model
