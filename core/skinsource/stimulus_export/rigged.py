"""What a rig says of a stimulus: calibration, channels, limits."""

from typing import Any

from skinsource.equalising import Equaliser
from skinsource.fields import specs_of
from skinsource.rigs import Rig, calibration_words, rig_breaches
from skinsource.stimulus import Stimulus
from skinsource.stimulus.wiring import added_delays_s, channel_of


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
    added_s = added_delays_s(stimulus, rig)
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
                "delay_added_s": added_s[row],
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
