"""Measuring one channel of a rig: silence, a quiet sweep that is checked, then the sweeps.

All devices are looked up, and all limits checked, before anything is played.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import UTC, date, datetime
from math import floor, log10

import numpy as np

from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.measuring import (
    AveragedResponse,
    Sweeps,
    averaged_response,
    clock_ratio,
    delay_of,
    excess_delay,
    exponential_sweep,
    part_from,
)
from skinsource.actuators.rigs import (
    Margin,
    Rig,
    RigChannel,
    full_scale_volts,
    highest_gain,
    wired_channel,
)
from skinsource.base.arguments import checking
from skinsource.base.conventions import Floats
from skinsource.base.decibels import decibels
from skinsource.base.errors import InvalidInputError, PlaybackError, sentence
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.lab.playing.devices import MOST_OUTPUTS, Output, check_outputs, device_of, devices
from skinsource.lab.playing.stream import (
    HIGHEST_DB,
    LOWEST_DB,
    Mix,
    PlayQueue,
    factor_of,
    fade_samples,
    mix_of,
)
from skinsource.lab.rig_measuring.duplex import (
    Card,
    Duplex,
    check_inputs,
    input_device_of,
    input_devices,
)
from skinsource.specs import fields
from skinsource.specs.numbers import SMALLEST, NumberSpec
from skinsource.specs.spec import TextSpec

#: Longest delay from output to input that is looked for.
LONGEST_DELAY_S = 0.5

SENSITIVITY = NumberSpec(
    label="Sensitivity",
    unit="V per m/s²",
    minimum=SMALLEST,
    maximum=1e6,
    hint="Accelerometer with amplifier; 100 mV per g is 0.0102 V per m/s²",
)
INPUT_VOLTS = NumberSpec(
    label="Input full scale",
    unit="V",
    minimum=SMALLEST,
    maximum=1e6,
    hint="Volts at the sound card input for a recorded 1",
)
INPUT = NumberSpec(
    label="Input", minimum=1, maximum=MOST_OUTPUTS, whole=True, hint="Where the accelerometer is"
)
LOOPBACK = NumberSpec(
    label="Loopback input",
    minimum=0,
    maximum=MOST_OUTPUTS,
    whole=True,
    hint="Input wired to the output, to measure the delay; 0: none",
)
INPUT_DEVICE = TextSpec(
    label="Input device",
    longest=400,
    one_line=True,
    hint="Recording device; empty: the playback device",
)
LEVEL = NumberSpec(
    label="Level",
    unit="dB",
    minimum=LOWEST_DB,
    maximum=min(HIGHEST_DB, 0.0),
    hint="Re full scale; a sweep 20 dB weaker comes first",
)
SWEEP = NumberSpec(label="Sweep", unit="s", minimum=1.0, maximum=60.0, hint="Length of each sweep")
REPEATS = NumberSpec(
    label="Repeats", minimum=2, maximum=50, whole=True, hint="Sweeps; their spread is the error"
)
LOWEST = NumberSpec(label="From", unit="Hz", minimum=2.0, maximum=20_000.0)
HIGHEST = NumberSpec(label="To", unit="Hz", minimum=2.0, maximum=20_000.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuringSetup:
    """The sensor, its wiring, and the sweep.

    Attributes
    ----------
    sensitivity_v_per_m_per_s2
        Volts at the input for 1 m/s².
    input_full_scale_v
        Voltage at the input where a recorded sample is 1.
    input_number, loopback_input
        Inputs, from 1, of the accelerometer, and of a wire from the measured output; 0 where there
        is no such wire.
    input_device
        Device to record from; empty for the device that plays.  Another device has a clock of its
        own, whose rate follows from the sweeps.
    level_db
        Amplitude of the sweep, dB of full scale.
    sweep_s, repeats
        Duration of a sweep, and how often it is played.
    lowest_hz, highest_hz
        Frequencies between which the response is measured.
    """

    sensitivity_v_per_m_per_s2: float = fields.number(0.0102, SENSITIVITY)
    input_full_scale_v: float = fields.number(1.0, INPUT_VOLTS)
    input_number: int = fields.number(1, INPUT)
    loopback_input: int = fields.number(0, LOOPBACK)
    input_device: str = fields.text("", INPUT_DEVICE)
    level_db: float = fields.number(-30.0, LEVEL)
    sweep_s: float = fields.number(5.0, SWEEP)
    repeats: int = fields.number(4, REPEATS)
    lowest_hz: float = fields.number(20.0, LOWEST)
    highest_hz: float = fields.number(1000.0, HIGHEST)

    def __post_init__(self) -> None:
        fields.check(self)
        if not self.lowest_hz * 1.5 <= self.highest_hz:
            raise InvalidInputError(
                f"the response is wanted from {self.lowest_hz:g} to {self.highest_hz:g} Hz, "
                "expected at least half an octave"
            )
        if self.loopback_input == self.input_number:
            raise InvalidInputError(
                f"input {self.input_number} is that of the accelerometer, and the loopback's; "
                "expected two inputs"
            )

    @property
    def band_hz(self) -> tuple[float, float]:
        """Frequencies between which the response is measured."""
        return self.lowest_hz, self.highest_hz

    @property
    def m_per_s2_at_full_scale(self) -> float:
        """Acceleration of a recorded sample of 1."""
        return self.input_full_scale_v / self.sensitivity_v_per_m_per_s2


# Silence after each sweep, in which ringing dies away.
_REST_S = 0.5
# The sweep extends beyond the measured band, so that the delay is exact, and the band complete.
_LOWER_SHARE, _HIGHER_SHARE = 0.6, 4.0
_HIGHEST_SHARE_OF_RATE = 0.42
# Channels that are opened at least, where the device has them: some devices offer pairs only.
FEWEST_CHANNELS = 2


@dataclass(frozen=True, slots=True, eq=False)
class Bench:
    """Devices, sweep and setup for measuring one channel."""

    channel: RigChannel
    volts: float
    setup: MeasuringSetup
    card: Card
    rate_hz: int
    sweep: Floats
    swept_hz: tuple[float, float]

    @property
    def numbers(self) -> tuple[int, ...]:
        """Inputs that are evaluated."""
        setup = self.setup
        return tuple(number for number in (setup.input_number, setup.loopback_input) if number)

    @property
    def period(self) -> int:
        """Samples from the start of a sweep to the start of the next."""
        return self.sweep.size + round(_REST_S * self.rate_hz)

    def sweep_by(self, clock_ratio: float) -> Floats:
        """Return one period, (period,), as counted by a clock that is so many times as quick."""
        samples = np.zeros(self.period)
        sweep = self.sweep
        if clock_ratio != 1.0:
            sweep = exponential_sweep(self.swept_hz, self.setup.sweep_s, self.rate_hz, clock_ratio)
        samples[: sweep.size] = sweep
        return samples

    def row(self, repeats: int, lead: int) -> Floats:
        """Return the samples that are played, at a gain of 1, (n_times,)."""
        period = self.sweep_by(1.0)
        tail = np.zeros(round(LONGEST_DELAY_S * self.rate_hz))
        return np.concatenate((np.zeros(lead), np.tile(period, repeats), tail))


@checking
def measurable(
    channel: RigChannel, setup: MeasuringSetup, sample_rate_hz: float
) -> tuple[float, float]:
    """Return the volts at full scale, and the highest frequency that can be measured, Hz.

    Raises
    ------
    InvalidInputError
        The channel cannot be measured with this setup on any device.
    """
    volts = full_scale_volts(channel)
    highest_hz = _HIGHEST_SHARE_OF_RATE * sample_rate_hz
    if setup.highest_hz > highest_hz:
        raise InvalidInputError(
            f"the response is requested up to {setup.highest_hz:g} Hz, and {sample_rate_hz:g} Hz "
            f"resolves at most {highest_hz:.0f} Hz; choose a higher rate"
        )
    return volts, highest_hz


def bench_of(rig: Rig, place: int, setup: MeasuringSetup, output: Output) -> Bench:
    """Return devices, sweep and setup; raise where something is missing, before playing."""
    channel = wired_channel(rig, place)
    rate_hz = output.sample_rate_hz
    volts, highest_hz = measurable(channel, setup, rate_hz)
    swept_hz = _LOWER_SHARE * setup.lowest_hz, min(_HIGHER_SHARE * setup.highest_hz, highest_hz)
    card = card_of(channel, setup, output)
    sweep = exponential_sweep(swept_hz, setup.sweep_s, rate_hz)
    return Bench(channel, volts, setup, card, rate_hz, sweep, swept_hz)


def card_of(channel: RigChannel, setup: MeasuringSetup, output: Output) -> Card:
    """Return the devices of a channel and of the sensor; raise where one is missing."""
    known_devices = devices()
    named = [device for device in known_devices if channel.device in (device.name, device.title)]
    if channel.device:
        name = named[0].name if named else channel.device
        api = named[0].host_api if named else ""
        output = replace(output, device=name, host_api=api)
    device = device_of(output, known_devices)
    check_outputs(device, {channel.place: channel.output})
    inputs = input_device_of(setup.input_device, device, input_devices())
    check_inputs(inputs, setup.input_number, setup.loopback_input)
    highest_input = max(setup.input_number, setup.loopback_input)
    return Card(
        device=device,
        inputs=inputs,
        n_inputs=max(highest_input, min(FEWEST_CHANNELS, inputs.n_inputs)),
        latency_s=output.latency_s,
    )


# A phase that differs more from that of a delay is doubtful; about 30 degrees.
_DOUBTFUL_RAD = 0.5
# Smaller differences of clocks do not follow from a sweep, and hardly change the phase.
_SAME_CLOCK_PPM = 0.1


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ChannelMeasurement:
    """The measured response of one channel, with its error.

    Attributes
    ----------
    place
        Input location of the channel.
    response
        Acceleration per volt at the actuator, without the delay.
    error : (n_points,)
        Standard error of each point of the response, relative to the gain.
    n_left_out
        Points of the band that are below the noise, and left out.
    delay_s
        From playing a sample to recording it: through the device, actuator and sensor; with two
        devices it contains the difference of their starts.
    delay_by_wire
        Whether the delay was measured with a loopback; otherwise it follows from the phase.
    played_on, recorded_from
        Names of the devices.
    clock_ppm
        How much quicker the clock of the inputs is than that of the outputs, in millionths; None
        where both are one device.
    inverted
        Whether the sensor moves against the voltage.
    misfit_rad
        Root mean square of the phase that neither gain nor delay explains.
    noise_m_per_s2
        RMS while nothing was played.
    peak_m_per_s2, peak_input_db
        Largest recorded acceleration, and the same at the input, dB of full scale.
    level_db
        Level of the sweep, dB of full scale.
    measured_on
        Date of the measurement.
    """

    place: int
    response: MeasuredResponse
    error: Floats
    n_left_out: int
    delay_s: float
    delay_by_wire: bool
    played_on: str
    recorded_from: str
    clock_ppm: float | None
    inverted: bool
    misfit_rad: float
    noise_m_per_s2: float
    peak_m_per_s2: float
    peak_input_db: float
    level_db: float
    measured_on: date

    @property
    def lines(self) -> tuple[str, ...]:
        """Report of the measurement, in sentences."""
        points = self.response.points
        by = "the loopback" if self.delay_by_wire else "the phase"
        typical, worst = 100.0 * np.median(self.error), 100.0 * np.max(self.error)
        left_out = f"; {self.n_left_out} under the noise are left out" if self.n_left_out else ""
        sentences = [
            f"Place {self.place}: {len(points)} points from {points[0][0]:.4g} to "
            f"{points[-1][0]:.4g} Hz{left_out}.",
            f"Their standard error is {typical:.2g} % (median), at most {worst:.2g} %.",
            f"The delay from output to input is {self.delay_s * 1e3:.2f} ms, measured from {by}; "
            "it is removed from the response.",
            *self._clocks,
            f"At the input: peak {self.peak_m_per_s2:.3g} m/s² ({self.peak_input_db:z.1f} dB of "
            f"full scale), noise {self.noise_m_per_s2:.2g} m/s² RMS.".replace("-", "\u2212"),
        ]
        if self.inverted:
            sentences.append(
                "The motion opposes the voltage: invert the polarity, or turn the sensor, and "
                "measure again."
            )
        if self.misfit_rad > _DOUBTFUL_RAD:
            sentences.append(
                f"Its phase is doubtful: gain and delay leave {np.degrees(self.misfit_rad):.0f}° "
                "unexplained. Wire a loopback, or check the sensor."
            )
        return tuple(sentences)

    @property
    def _clocks(self) -> tuple[str, ...]:
        """Sentences on the clocks, where there are two devices."""
        ppm = self.clock_ppm
        if ppm is None:
            return ()
        if abs(ppm) < _SAME_CLOCK_PPM:
            clocks = "Their clocks agree."
        else:
            clocks = (
                f"The clock of the input is {abs(ppm):.1f} ppm "
                f"{'faster' if ppm > 0.0 else 'slower'}, measured from the sweeps; the response "
                "is corrected for it."
            )
        return (
            f"Output and input are two devices, {self.played_on} and {self.recorded_from}, which "
            "start independently: the delay is that of this take alone.",
            clocks,
        )


@checking
def kept(rig: Rig, measurement: ChannelMeasurement) -> Rig:
    """Return the rig with the measured response and its date in the channel.

    Raises
    ------
    InvalidInputError
        The rig has no channel for that location any more.
    """
    channel = wired_channel(rig, measurement.place)
    day = measurement.measured_on.isoformat()
    changed = replace(channel, measured=measurement.response, measured_on=day)
    channels = tuple(changed if each is channel else each for each in rig.channels)
    return replace(rig, channels=channels)


#: How much weaker the first sweep is, dB.
QUIETER_DB = 20.0
#: Silence in which the noise is measured, and the time before it in which a device settles.
NOISE_S, SETTLING_S = 2.0, 0.2
#: From this recorded sample on the input may be clipped, whatever bits the device has.
CLIPPED = 0.999


def measure(
    rig: Rig,
    place: int,
    setup: MeasuringSetup,
    *,
    output: Output | None = None,
    progress: Progress = silent,
    stop: Stop = never,
) -> ChannelMeasurement:
    """Measure the response of a channel of a rig, with an accelerometer on an input.

    Limits of the rig are kept.  A sweep that is 20 dB quieter comes first, and the louder sweeps
    are not played where the input would clip, or a limit would be passed by the response.

    Parameters
    ----------
    rig, place
        What is wired to the device, and the input location of the channel.
    setup
        The sensor and the sweep.
    output
        Sample rate and delay of the device, and the device where the channel names none.
    progress, stop
        ``progress`` is called while samples are recorded; once ``stop`` returns True, all is silent
        and `Stopped` is raised.

    Raises
    ------
    InvalidInputError
        The rig states too little of the channel, a limit would be passed, the input would clip, or
        the response is not above the noise.
    PlaybackError
        sounddevice, the device or an input is missing, the device refuses, or it stops answering.
    Stopped
        ``stop`` returned True.
    """
    bench = bench_of(rig, place, setup, output or Output())
    settling = round(SETTLING_S * bench.rate_hz)
    lead = settling + round(NOISE_S * bench.rate_hz)
    row, loud_db = bench.row(setup.repeats, settling), setup.level_db
    margin = _margin(bench.channel, row, bench.rate_hz, loud_db)
    quiet_db = max(loud_db - QUIETER_DB, LOWEST_DB)
    # The difference of two clocks follows from the distance of two sweeps.
    n_quiet = 2 if bench.card.two_clocks else 1
    first = bench.row(n_quiet, lead)
    total = first.size + row.size
    recorded = _record(
        bench, first, quiet_db, margin, stop, lambda done: progress(done, total, "Quiet sweep")
    )
    noise = recorded[:, settling:lead]
    _check_clipping(bench, recorded, quiet_db)
    _check_level(bench, recorded, noise, quiet_db)
    averaged, _ = _averaged_from(bench, recorded, noise, quiet_db, lead, n_quiet)
    if isinstance(averaged, AveragedResponse):
        measured_channel = replace(bench.channel, measured=_response(averaged))
        margin = _margin(measured_channel, row, bench.rate_hz, loud_db)
    stop_if(stop)
    label = f"{setup.repeats} sweeps"
    recorded = _record(
        bench, row, loud_db, margin, stop, lambda done: progress(first.size + done, total, label)
    )
    _check_clipping(bench, recorded, loud_db)
    averaged, ratio = _averaged_from(bench, recorded, noise, loud_db, settling, setup.repeats)
    if isinstance(averaged, InvalidInputError):
        raise averaged
    return _measurement_of(bench, averaged, recorded, noise, ratio)


def _measurement_of(
    bench: Bench, averaged: AveragedResponse, recorded: Floats, noise: Floats, ratio: float
) -> ChannelMeasurement:
    """Return the response with its errors, noise and levels."""
    setup = bench.setup
    scale = setup.m_per_s2_at_full_scale
    sensor = recorded[setup.input_number - 1] - noise[setup.input_number - 1].mean()
    # A delay by wire says nothing about the phase of the sensor.
    phase = averaged.delay
    if setup.loopback_input:
        phase = excess_delay(averaged.frequency_hz, averaged.response)
    return ChannelMeasurement(
        place=bench.channel.place,
        response=_response(averaged),
        error=averaged.error,
        n_left_out=averaged.n_left_out,
        delay_s=averaged.delay.seconds,
        delay_by_wire=setup.loopback_input > 0,
        played_on=bench.card.device.name,
        recorded_from=bench.card.inputs.name,
        clock_ppm=1e6 * (ratio - 1.0) if bench.card.two_clocks else None,
        inverted=phase.inverted,
        misfit_rad=phase.misfit_rad,
        noise_m_per_s2=float(noise[setup.input_number - 1].std() * scale),
        peak_m_per_s2=float(np.abs(sensor).max() * scale),
        peak_input_db=float(decibels(np.abs(recorded[setup.input_number - 1]).max())),
        level_db=setup.level_db,
        measured_on=datetime.now(UTC).date(),
    )


def _margin(channel: RigChannel, row: Floats, rate_hz: int, level_db: float) -> Margin:
    """Return the highest gain that the rig allows; raise where ``level_db`` is higher."""
    margin = highest_gain(Rig(channels=(channel,)), [channel.place], row[np.newaxis], rate_hz)
    if factor_of(level_db) <= margin.factor:
        return margin
    if margin.factor == 0.0:
        advice = "choose shorter sweeps, or fewer of them"
    else:
        advice = f"choose a level of {_rounded_down(20.0 * log10(margin.factor))} dB or less"
    raise InvalidInputError(
        f"at {minus(f'{level_db:g}')} dB the sweep would pass a limit of the rig "
        f"({margin.words}); {advice}"
    )


def _record(
    bench: Bench,
    row: Floats,
    level_db: float,
    margin: Margin,
    stop: Stop,
    report: Callable[[int], None],
) -> Floats:
    """Play a row, and return the recorded samples, (n_inputs, n_times), from its start on."""
    output = bench.channel.output
    mix = mix_of(
        row[np.newaxis],
        bench.rate_hz,
        outputs=[output],
        titles=[f"sweep of place {bench.channel.place}"],
        n_outputs=output,
    )
    mix = replace(mix, most_gain=margin.factor, limit=margin.words)
    return recording_of(mix, bench.card, level_db, stop, report)[0]


def recording_of(
    mix: Mix, card: Card, level_db: float, stop: Stop, report: Callable[[int], None]
) -> tuple[Floats, float | None]:
    """Play a mix at a level, and return what its time of all inputs recorded, (n_inputs, n_times).

    Returns the samples, and how much earlier than told they were played they were recorded, s, as
    `Duplex.shift_s`.

    Raises
    ------
    PlaybackError
        The device refuses, loses samples or stops answering, or a limit of the mix would be passed.
    Stopped
        ``stop`` returned True.
    """
    fade = fade_samples(mix.sample_rate_hz)
    n_outputs = max(mix.n_outputs, min(FEWEST_CHANNELS, card.device.n_outputs))
    queue = PlayQueue(n_outputs, mix.sample_rate_hz, level_db)
    queue.play(mix, 0)
    duplex = Duplex(queue, card, fade + mix.n_times)
    duplex.run(stop, report)
    ending = queue.ending
    if ending is not None and ending.reason != "end":
        raise PlaybackError(ending.sentence)
    if duplex.n_lost:
        raise PlaybackError(
            f"Samples were lost {duplex.n_lost} times while measuring, so the recording has gaps. "
            "Close other programs, or choose a longer latency."
        )
    # The queue begins with a fade of silence before the first sample.
    return duplex.recorded[:, fade:].astype(np.float64), duplex.shift_s


def _check_clipping(bench: Bench, recorded: Floats, level_db: float) -> None:
    """Raise where recorded samples reach full scale of an input."""
    for number in bench.numbers:
        peak = float(np.abs(recorded[number - 1]).max(initial=0.0))
        if not np.isfinite(peak):
            raise PlaybackError("The device recorded a value that is no number. Choose another.")
        if peak >= CLIPPED:
            raise _clipping_error(number, "clips", level_db, "a lower level")


def _check_level(bench: Bench, recorded: Floats, noise: Floats, level_db: float) -> None:
    """Raise where samples would reach full scale of an input at the level of the setup."""
    louder = 10.0 ** ((bench.setup.level_db - level_db) / 20.0)
    for number in bench.numbers:
        mean = float(noise[number - 1].mean())
        still = abs(mean) + float(np.abs(noise[number - 1] - mean).max())
        # The noise does not become louder with the sweep.
        moved = max(float(np.abs(recorded[number - 1] - mean).max()) + abs(mean) - still, 0.0)
        if still + moved * louder >= CLIPPED:
            most_db = level_db + 20.0 * log10((CLIPPED - still) / moved) - 0.1
            raise _clipping_error(
                number, "would clip", bench.setup.level_db, f"{_rounded_down(most_db)} dB or less"
            )


def _clipping_error(number: int, what: str, level_db: float, advice: str) -> InvalidInputError:
    return InvalidInputError(
        f"input {number} {what} at {minus(f'{level_db:g}')} dB; choose {advice}, or turn the gain "
        "of that input down"
    )


def _averaged_from(
    bench: Bench, recorded: Floats, noise: Floats, level_db: float, start: int, repeats: int
) -> tuple[AveragedResponse | InvalidInputError, float]:
    """Return the averaged response, or the error where it is too weak, and the clock ratio."""
    setup, latest = bench.setup, round(LONGEST_DELAY_S * bench.rate_hz)
    ratio = 1.0
    if bench.card.two_clocks:
        # The loopback has the best signal.
        number = setup.loopback_input or setup.input_number
        still = recorded[number - 1] - noise[number - 1].mean()
        ratio = clock_ratio(still, start, bench.period, repeats)
    sent = bench.sweep_by(ratio) * factor_of(level_db)

    def sweeps_of(number: int, played: Floats, scale: float) -> Sweeps:
        mean = noise[number - 1].mean()
        n = bench.period + latest
        begins = start + bench.period * ratio * np.arange(repeats)
        parts = [part_from(recorded[number - 1] - mean, begin, n) for begin in begins]
        silence = (noise[number - 1] - mean) * scale
        return Sweeps(played, np.stack(parts) * scale, silence, bench.rate_hz)

    delay = None
    try:
        sensor = sweeps_of(setup.input_number, sent * bench.volts, setup.m_per_s2_at_full_scale)
        if setup.loopback_input:
            delay = delay_of(sweeps_of(setup.loopback_input, sent, 1.0), bench.swept_hz)
        return averaged_response(sensor, setup.band_hz, bench.swept_hz, delay), ratio
    except InvalidInputError as error:
        return InvalidInputError(sentence(str(error))), ratio


def _response(averaged: AveragedResponse) -> MeasuredResponse:
    return MeasuredResponse.of(averaged.frequency_hz, averaged.response)


def _rounded_down(decibels_: float) -> str:
    """Return decibels as text, rounded down, so that the advised level is low enough."""
    return minus(f"{floor(10.0 * decibels_) / 10.0:.1f}")


def minus(text: str) -> str:
    """Return a text with proper minus signs."""
    return text.replace("-", "\u2212")
