"""A stimulus for the channels of a rig: which way round, how many volts, and when."""

from math import floor
from typing import Any

import numpy as np

from skinsource.actuators import load, names
from skinsource.chain import ARBITRARY_UNIT, Actuation
from skinsource.equalising import Equaliser, equalised, followed_band
from skinsource.errors import InvalidInputError
from skinsource.limb import Band
from skinsource.quoting import quoted
from skinsource.rigs import Rig, RigChannel
from skinsource.sampling import band_limited_delay
from skinsource.stimulus.stimulus import Stimulus

#: Unit of samples that are volts, divided by what each channel gives at full scale.
FULL_SCALE_UNIT = "full scale of the channel"
# Less than so much of a sample is no delay.
_NO_DELAY = 1e-6


def for_rig(
    stimulus: Stimulus, rig: Rig, equaliser: Equaliser | None, *, scaled: bool = False
) -> Stimulus:
    """Return what the channels of a rig must play.

    With an equaliser, or where drives are volts, samples are in parts of full scale of their own
    channel, polarity included; those that need more volts than it gives lie beyond 1.  Otherwise
    only polarity is turned.  Channels wait for the one with the longest delay, so that all move
    together.

    Parameters
    ----------
    scaled
        Whether a full scale is chosen elsewhere: volts then stay what they are.

    Raises
    ------
    InvalidInputError
        A place is not wired, drives are no accelerations, one leaves a velocity, or the rig does
        not know the volts at full scale or how an actuator moves.
    """
    if equaliser is not None:
        found = _equalised_for(stimulus, rig, equaliser)
    elif stimulus.unit == "V" and not scaled:
        found = _volts_for(stimulus, rig)
    else:
        found = _wired(stimulus, rig)
    return _aligned(found, rig)


def through_actuators(stimulus: Stimulus, actuation: Actuation, equaliser: Equaliser) -> Stimulus:
    """Return the volts that make actuators accelerate as the drives say, without a rig.

    Raises
    ------
    InvalidInputError
        As `for_rig`; or a place has no actuator.
    """
    _refuse_other_drives(stimulus)
    samples, band = np.array(stimulus.samples), _band_of(stimulus)
    for row in stimulus.driving:
        place = stimulus.channels[row].place
        if place is not None:
            model = actuation.at(place).model
            samples[row] = equalised(
                samples[row], stimulus.sample_rate_hz, model, equaliser, band_hz=band
            )
    return stimulus.with_samples(samples, unit="V")


def channel_of(stimulus: Stimulus, row: int, rig: Rig) -> RigChannel:
    """The channel of the rig that a row of the samples goes to."""
    place = stimulus.channels[row].place
    found = None if place is None else rig.channel_of(place)
    if found is None:
        raise InvalidInputError(
            f"place {place} is not wired in the rig; add a channel for it, or leave it out"
        )
    return found


def added_delays_s(stimulus: Stimulus, rig: Rig) -> dict[int, float]:
    """By row that drives an actuator: how long its channel waits for the slowest."""
    own = {row: channel_of(stimulus, row, rig).delay_s for row in stimulus.driving}
    longest = max(own.values(), default=0.0)
    return {row: longest - delay_s for row, delay_s in own.items()}


def _wired(stimulus: Stimulus, rig: Rig) -> Stimulus:
    sign = np.ones((len(stimulus.channels), 1))
    for row in stimulus.driving:
        if channel_of(stimulus, row, rig).polarity == "inverted":
            sign[row] = -1.0
    return stimulus if (sign > 0).all() else stimulus.with_samples(stimulus.samples * sign)


def _equalised_for(stimulus: Stimulus, rig: Rig, equaliser: Equaliser) -> Stimulus:
    _refuse_other_drives(stimulus)
    samples, band = np.array(stimulus.samples), _band_of(stimulus)
    for row in stimulus.driving:
        channel = channel_of(stimulus, row, rig)
        volts = equalised(
            stimulus.samples[row],
            stimulus.sample_rate_hz,
            _actuator_of(channel),
            equaliser,
            band_hz=band,
        )
        samples[row] = volts / _full_scale_v(channel)
    return stimulus.with_samples(samples, unit=FULL_SCALE_UNIT)


def _band_of(stimulus: Stimulus) -> Band:
    """In which the drives are followed: what they hold of the band of the limb."""
    lower_hz = min(stimulus.sample_rate_hz, stimulus.own_rate_hz)
    return followed_band(stimulus.limb_band_hz, lower_hz)


def _volts_for(stimulus: Stimulus, rig: Rig) -> Stimulus:
    samples = np.array(stimulus.samples)
    for row in stimulus.driving:
        samples[row] /= _full_scale_v(channel_of(stimulus, row, rig))
    return stimulus.with_samples(samples, unit=FULL_SCALE_UNIT)


def _aligned(stimulus: Stimulus, rig: Rig) -> Stimulus:
    later = {
        row: delay_s * stimulus.sample_rate_hz
        for row, delay_s in added_delays_s(stimulus, rig).items()
    }
    longest = max(later.values(), default=0.0)
    if longest < _NO_DELAY:
        return stimulus
    found = np.zeros((len(stimulus.channels), stimulus.n_times + floor(longest) + 1))
    found[:, : stimulus.n_times] = stimulus.samples
    for row, samples in later.items():
        whole = floor(samples)
        moved = stimulus.samples[row]
        if _NO_DELAY < samples - whole < 1.0 - _NO_DELAY:
            moved = band_limited_delay(moved, samples - whole)
        else:
            whole = round(samples)
        found[row] = 0.0
        found[row, whole : whole + moved.size] = moved
    return stimulus.with_samples(found)


def _refuse_other_drives(stimulus: Stimulus) -> None:
    if stimulus.unit == "V":
        raise InvalidInputError(
            "The drives of this design are volts already: it is predicted through an actuator "
            "without an equaliser. Choose an equaliser there, or none here."
        )
    if stimulus.unit == ARBITRARY_UNIT:
        raise InvalidInputError(
            "An equaliser needs accelerations, and the limb of this design answers a drive of "
            "unknown unit. Let the design be predicted through an actuator: its amplitudes are "
            "then accelerations of the contactor."
        )
    if stimulus.unit != "m/s²":
        raise InvalidInputError(
            "An equaliser needs accelerations, and the drives of this design are none: its scaling "
            f"is {stimulus.scaling}. Choose the scaling Probe acceleration."
        )


def _full_scale_v(channel: RigChannel) -> float:
    found = channel.volts_at_full_scale
    if found is None:
        raise InvalidInputError(
            f"place {channel.place}: the rig does not say the volts at full scale. Measure them "
            "with a tone at full scale and a voltmeter."
        )
    return found


def _actuator_of(channel: RigChannel) -> Any:
    """How it moves: as it was measured, else as its model says, else as the one of its name."""
    if channel.moves_as is not None:
        return channel.moves_as
    if channel.actuator in names():
        return load(channel.actuator)
    raise InvalidInputError(
        f"place {channel.place}: the rig does not say how the actuator "
        f"{quoted(channel.actuator)} moves. Measure it, or name one of {', '.join(names())}."
    )
