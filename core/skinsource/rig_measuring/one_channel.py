"""Measures one channel: silence, a quiet sweep that is looked at, then the sweeps that count."""

from collections.abc import Callable
from dataclasses import replace
from datetime import UTC, datetime
from functools import partial
from math import floor, log10

import numpy as np

from skinsource.actuators import MeasuredResponse
from skinsource.arrays import Floats
from skinsource.decibels import decibels
from skinsource.errors import InvalidInputError, PlaybackError
from skinsource.job import Progress, Stop, never, silent, stop_if
from skinsource.measuring.clock_ratio import clock_ratio, part_from
from skinsource.measuring.loop_delay import excess_delay
from skinsource.measuring.repeated_sweeps import (
    AveragedResponse,
    Sweeps,
    averaged_response,
    delay_of,
)
from skinsource.playing import LOWEST_DB, Deck, Output, mix_of
from skinsource.playing.gain import factor_of
from skinsource.playing.mix import fade_samples
from skinsource.quoting import sentence
from skinsource.rig_measuring.bench import FEWEST_WAYS, Bench, bench_of
from skinsource.rig_measuring.channel_measurement import ChannelMeasurement
from skinsource.rig_measuring.duplex import Duplex
from skinsource.rig_measuring.setup import LONGEST_DELAY_S, MeasuringSetup
from skinsource.rigs import Margin, Rig, RigChannel, highest_gain

#: How much weaker the first sweep is, dB.
QUIETER_DB = 20.0
#: Silence in which the noise is measured; what a device does when it begins is not part of it.
NOISE_S, SETTLING_S = 2.0, 0.2
# Recorded samples from here on may be clipped, whatever bits the device has.
_CLIPPED = 0.999


def measure(
    rig: Rig,
    place: int,
    setup: MeasuringSetup,
    *,
    output: Output | None = None,
    progress: Progress = silent,
    stop: Stop = never,
) -> ChannelMeasurement:
    """Measure how a channel of a rig answers, with an accelerometer on an input.

    Nothing is played that passes a limit of the rig.  A sweep that is 20 dB quieter comes first:
    what would clip at the input, or pass a limit once the response is known, is not played louder.

    Parameters
    ----------
    rig, place
        What is wired to the device, and which channel is measured.
    setup
        The sensor, and the sweep.
    output
        Device where the channel names none, its rate and the delay that it is asked for.

    Raises
    ------
    InvalidInputError
        The channel is not known so far that it can be measured, a limit would be passed, the
        input would clip, or nothing is heard above the noise.
    PlaybackError
        sounddevice, the device or an input is missing, the device refuses, or it is gone before
        the end.
    Stopped
        ``stop`` said so.
    """
    bench = bench_of(rig, place, setup, output or Output())
    settling = round(SETTLING_S * bench.rate_hz)
    lead = settling + round(NOISE_S * bench.rate_hz)
    row, loud_db = bench.row(setup.repeats, settling), setup.level_db
    margin = _margin(bench.channel, row, bench.rate_hz, loud_db)
    quiet_db = max(loud_db - QUIETER_DB, LOWEST_DB)
    # How two clocks differ is told from one sweep to the next.
    n_quiet = 2 if bench.card.two_clocks else 1
    first = bench.row(n_quiet, lead)
    told = partial(_tell, progress, first.size + row.size)
    heard = _take(bench, first, quiet_db, margin, stop, partial(told, 0, "Quiet sweep"))
    noise = heard[:, settling:lead]
    _refuse_clipping(bench, heard, quiet_db)
    _refuse_what_will_clip(bench, heard, noise, quiet_db)
    found, _ = _found(bench, heard, noise, quiet_db, lead, n_quiet)
    if isinstance(found, AveragedResponse):
        known = replace(bench.channel, measured=_response(found))
        margin = _margin(known, row, bench.rate_hz, loud_db)
    stop_if(stop)
    words = f"{setup.repeats} sweeps"
    heard = _take(bench, row, loud_db, margin, stop, partial(told, first.size, words))
    _refuse_clipping(bench, heard, loud_db)
    found, ratio = _found(bench, heard, noise, loud_db, settling, setup.repeats)
    if isinstance(found, InvalidInputError):
        raise found
    return _told(bench, found, heard, noise, ratio)


def _told(
    bench: Bench, found: AveragedResponse, heard: Floats, noise: Floats, ratio: float
) -> ChannelMeasurement:
    """What was found, with all that says how far it can be trusted."""
    setup = bench.setup
    scale = setup.m_per_s2_at_full_scale
    own = heard[setup.input_number - 1] - noise[setup.input_number - 1].mean()
    # A wire says nothing of the sensor's phase.
    phase = found.delay
    if setup.loopback_input:
        phase = excess_delay(found.frequency_hz, found.response)
    return ChannelMeasurement(
        place=bench.channel.place,
        response=_response(found),
        error=found.error,
        n_left_out=found.n_left_out,
        delay_s=found.delay.seconds,
        delay_by_wire=setup.loopback_input > 0,
        played_on=bench.card.device.name,
        recorded_from=bench.card.inputs.name,
        clock_ppm=1e6 * (ratio - 1.0) if bench.card.two_clocks else None,
        inverted=phase.inverted,
        misfit_rad=phase.misfit_rad,
        noise_m_per_s2=float(noise[setup.input_number - 1].std() * scale),
        peak_m_per_s2=float(np.abs(own).max() * scale),
        peak_input_db=float(decibels(np.abs(heard[setup.input_number - 1]).max())),
        level_db=setup.level_db,
        measured_on=datetime.now(UTC).date(),
    )


def _margin(channel: RigChannel, row: Floats, rate_hz: int, level_db: float) -> Margin:
    """How loud the rig lets it be; refuses what is louder."""
    margin = highest_gain(Rig(channels=(channel,)), [channel.place], row[np.newaxis], rate_hz)
    if factor_of(level_db) <= margin.factor:
        return margin
    if margin.factor == 0.0:
        advice = "choose shorter sweeps, or fewer of them"
    else:
        advice = f"choose a level of {_down(20.0 * log10(margin.factor))} dB or less"
    raise InvalidInputError(
        f"at {_minus(f'{level_db:g}')} dB the sweep would pass a limit of the rig "
        f"({margin.words}); {advice}"
    )


def _tell(progress: Progress, total: int, before: int, words: str, done: int) -> None:
    progress(before + done, total, words)


def _take(
    bench: Bench,
    row: Floats,
    level_db: float,
    margin: Margin,
    stop: Stop,
    told: Callable[[int], None],
) -> Floats:
    """Play a row, and return what came in, (n_inputs, n_times), from its first sample on."""
    output, fade = bench.channel.output, fade_samples(bench.rate_hz)
    n_outputs = max(output, min(FEWEST_WAYS, bench.card.device.n_outputs))
    mix = mix_of(
        row[np.newaxis],
        bench.rate_hz,
        outputs=[output],
        titles=[f"sweep of place {bench.channel.place}"],
        n_outputs=n_outputs,
    )
    mix = replace(mix, most_gain=margin.factor, limit=margin.words)
    deck = Deck(n_outputs, bench.rate_hz, level_db)
    deck.play(mix, 0)
    duplex = Duplex(deck, bench.card, fade + row.size)
    duplex.run(stop, told)
    ending = deck.ending
    if ending is not None and ending.reason != "end":
        raise PlaybackError(ending.sentence)
    if duplex.n_lost:
        raise PlaybackError(
            f"Samples were lost {duplex.n_lost} times while measuring, so that what was recorded "
            "has holes. Close other programs, or ask the device for a longer delay."
        )
    # The deck fades in what stands before its first sample: silence.
    return duplex.recorded[:, fade:].astype(np.float64)


def _refuse_clipping(bench: Bench, heard: Floats, level_db: float) -> None:
    """Refuse what reaches the ends of an input."""
    for number in bench.numbers:
        peak = float(np.abs(heard[number - 1]).max(initial=0.0))
        if not np.isfinite(peak):
            raise PlaybackError("The device recorded something that is no number. Choose another.")
        if peak >= _CLIPPED:
            raise _clips(number, "clips", level_db, "a lower level")


def _refuse_what_will_clip(bench: Bench, heard: Floats, noise: Floats, level_db: float) -> None:
    """Refuse what would reach the ends of an input at the level that is wanted."""
    louder = 10.0 ** ((bench.setup.level_db - level_db) / 20.0)
    for number in bench.numbers:
        mean = float(noise[number - 1].mean())
        still = abs(mean) + float(np.abs(noise[number - 1] - mean).max())
        # The noise stays as loud as it is.
        moved = max(float(np.abs(heard[number - 1] - mean).max()) + abs(mean) - still, 0.0)
        if still + moved * louder >= _CLIPPED:
            most_db = level_db + 20.0 * log10((_CLIPPED - still) / moved) - 0.1
            raise _clips(number, "would clip", bench.setup.level_db, f"{_down(most_db)} dB or less")


def _clips(number: int, what: str, level_db: float, advice: str) -> InvalidInputError:
    return InvalidInputError(
        f"input {number} {what} at {_minus(f'{level_db:g}')} dB; choose {advice}, or turn the gain "
        "of that input down"
    )


def _found(
    bench: Bench, heard: Floats, noise: Floats, level_db: float, start: int, repeats: int
) -> tuple[AveragedResponse | InvalidInputError, float]:
    """The response of what was heard, or the error where that is not enough; and the clocks."""
    setup, latest = bench.setup, round(LONGEST_DELAY_S * bench.rate_hz)
    ratio = 1.0
    if bench.card.two_clocks:
        # A wire says it best.
        number = setup.loopback_input or setup.input_number
        still = heard[number - 1] - noise[number - 1].mean()
        ratio = clock_ratio(still, start, bench.period, repeats)
    sent = bench.sweep_by(ratio) * factor_of(level_db)

    def sweeps_of(number: int, played: Floats, scale: float) -> Sweeps:
        mean = noise[number - 1].mean()
        n = bench.period + latest
        begins = start + bench.period * ratio * np.arange(repeats)
        parts = [part_from(heard[number - 1] - mean, begin, n) for begin in begins]
        silence = (noise[number - 1] - mean) * scale
        return Sweeps(played, np.stack(parts) * scale, silence, bench.rate_hz)

    known = None
    try:
        own = sweeps_of(setup.input_number, sent * bench.volts, setup.m_per_s2_at_full_scale)
        if setup.loopback_input:
            known = delay_of(sweeps_of(setup.loopback_input, sent, 1.0), bench.swept_hz)
        return averaged_response(own, setup.band_hz, bench.swept_hz, known), ratio
    except InvalidInputError as error:
        return InvalidInputError(sentence(str(error))), ratio


def _response(found: AveragedResponse) -> MeasuredResponse:
    return MeasuredResponse.of(found.frequency_hz, found.response)


def _down(decibels_: float) -> str:
    """Rounded down, so that what is said is enough."""
    return _minus(f"{floor(10.0 * decibels_) / 10.0:.1f}")


def _minus(words: str) -> str:
    return words.replace("-", "\u2212")
