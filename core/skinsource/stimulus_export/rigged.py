"""A stimulus for the channels of a rig: which way round, and how many volts."""

from typing import Any

import numpy as np

from skinsource.actuators import load, names
from skinsource.equalising import Equaliser, equalised
from skinsource.errors import InvalidInputError
from skinsource.fields import specs_of
from skinsource.quoting import quoted
from skinsource.rigs import Rig, RigChannel, calibration_words, rig_breaches
from skinsource.stimulus import Stimulus

#: Unit of samples that are volts, divided by what each channel gives at full scale.
FULL_SCALE_UNIT = "full scale of the channel"


def wired(stimulus: Stimulus, rig: Rig) -> Stimulus:
    """Turn round the channels whose actuators push the other way.

    Raises
    ------
    InvalidInputError
        A place is not wired.
    """
    sign = np.ones((len(stimulus.channels), 1))
    for row in stimulus.driving:
        if channel_of(stimulus, row, rig).polarity == "inverted":
            sign[row] = -1.0
    return stimulus if (sign > 0).all() else stimulus.with_samples(stimulus.samples * sign)


def equalised_for(stimulus: Stimulus, rig: Rig, equaliser: Equaliser) -> Stimulus:
    """Return what each channel must play so that its actuator accelerates as the drive says.

    Samples are in parts of full scale of their own channel, polarity included; those that need
    more volts than it gives lie beyond 1.

    Raises
    ------
    InvalidInputError
        Drives are no accelerations, one leaves a velocity, or the rig does not know the volts at
        full scale or how the actuator moves.
    """
    if stimulus.unit == "V":
        raise InvalidInputError(
            "The drives of this design are volts already: it is predicted through an actuator "
            "without an equaliser. Choose an equaliser there, or none here."
        )
    if stimulus.unit != "m/s²":
        raise InvalidInputError(
            "An equaliser needs accelerations, and the drives of this design are none: its scaling "
            f"is {stimulus.scaling}. Choose the scaling Probe acceleration."
        )
    samples = np.array(stimulus.samples)
    for row in stimulus.driving:
        channel = channel_of(stimulus, row, rig)
        volts = equalised(
            stimulus.samples[row], stimulus.sample_rate_hz, _actuator_of(channel), equaliser
        )
        samples[row] = volts / _full_scale_v(channel)
    return stimulus.with_samples(samples, samples_unit=FULL_SCALE_UNIT)


def volts_for(stimulus: Stimulus, rig: Rig) -> Stimulus:
    """Return the samples that give the volts of ``stimulus``, in parts of full scale.

    Raises
    ------
    InvalidInputError
        A place is not wired, or the rig does not know its volts at full scale.
    """
    samples = np.array(stimulus.samples)
    for row in stimulus.driving:
        samples[row] /= _full_scale_v(channel_of(stimulus, row, rig))
    return stimulus.with_samples(samples, samples_unit=FULL_SCALE_UNIT)


def channel_of(stimulus: Stimulus, row: int, rig: Rig) -> RigChannel:
    """The channel of the rig that a row of the samples goes to."""
    place = stimulus.channels[row].place
    found = None if place is None else rig.channel_of(place)
    if found is None:
        raise InvalidInputError(
            f"place {place} is not wired in the rig; add a channel for it, or leave it out"
        )
    return found


def passed_limits(stimulus: Stimulus, rig: Rig) -> tuple[str, ...]:
    """Sentences on the limits that samples in parts of full scale would pass."""
    rows = list(stimulus.driving)
    places = [place for row in rows if (place := stimulus.channels[row].place) is not None]
    rate_hz = round(stimulus.sample_rate_hz)
    breaches = rig_breaches(rig, places, stimulus.samples[rows], rate_hz)
    return tuple(f"{str(one)[:1].upper()}{str(one)[1:]}." for one in breaches)


def about_rig(stimulus: Stimulus, rig: Rig | None) -> str:
    """Whether it is calibrated, in words."""
    places = [one.place for one in stimulus.channels if one.place is not None]
    return calibration_words(rig, places)


def about_channels(stimulus: Stimulus, rig: Rig) -> list[dict[str, Any]]:
    """What the rig says of each channel; nothing of those that drive no actuator."""
    found: list[dict[str, Any]] = []
    for row, one in enumerate(stimulus.channels):
        if one.place is None:
            found.append({})
            continue
        channel = channel_of(stimulus, row, rig)
        found.append(
            {
                "actuator": channel.actuator,
                "device": channel.device,
                "output": channel.output,
                "full_scale_v": channel.full_scale_v,
                "amplifier_gain": channel.amplifier_gain,
                "polarity": channel.polarity,
                "delay_s": channel.delay_s,
                "measured_on": channel.measured_on,
            }
        )
    return found


def about_equaliser(equaliser: Equaliser | None) -> dict[str, Any] | None:
    """Kind and numbers of an equaliser."""
    if equaliser is None:
        return None
    values = {name: getattr(equaliser, name) for name in specs_of(equaliser)}
    return {"kind": type(equaliser).__name__, **values}


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
