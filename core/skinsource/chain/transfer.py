"""What equaliser and actuator make of a drive, as one impulse response at the rate of the limb."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy

from skinsource.actuators import Actuator
from skinsource.arrays import Floats
from skinsource.chain.actuation import Actuation, ActuatorAt
from skinsource.equalising import Equaliser
from skinsource.errors import InvalidInputError
from skinsource.limb import BAND_HZ
from skinsource.quoting import quoted

# Twelve seconds at the rate of the limbs: what rings longer than that is refused anyway.
_LENGTH = 2**14
#: Longest ringing that is kept before a drive begins and after it ends, as in exports.
LONGEST_S = 0.5
# Energy that is left out at each end where it ends sooner, and what may be beyond the longest.
_LEFT_OUT, _MOST_BEYOND = 1e-10, 1e-4
# Of half the rate: the end of the band in a limb that is sampled more slowly than the others.
_OF_HALF = 12.0 / 13.0


@dataclass(frozen=True, slots=True, eq=False)
class Transfer:
    """From a drive to the acceleration of the contactor.

    Attributes
    ----------
    samples : (n,)
        Impulse response: m/s² for each unit of the drive, with nothing above 600 Hz at full gain.
    lead
        Samples of it that lie before time 0: an equaliser without delay swings before it starts.
    """

    samples: Floats
    lead: int


def transfers_of(actuation: Actuation, sample_rate_hz: float) -> dict[int | None, Transfer]:
    """Transfers by place, None for all other places; all of one length and lead.

    Raises
    ------
    InvalidInputError
        An actuator does not move in the band, or rings for longer than half a second.
    """
    whole = {
        one.place: _whole(one, actuation.equaliser, sample_rate_hz) for one in actuation.actuators
    }
    lead = max(_reach(row[: -_LENGTH // 2 : -1], row) for row in whole.values())
    tail = max(_reach(row[: _LENGTH // 2], row) for row in whole.values())
    most = int(LONGEST_S * sample_rate_hz)
    lead, tail = min(lead, most), min(tail, most)
    found = {}
    for one in actuation.actuators:
        row = whole[one.place]
        kept = np.concatenate((row[_LENGTH - lead :], row[:tail]))
        _refuse_ringing(one, kept, row)
        kept.flags.writeable = False
        found[one.place] = Transfer(kept, lead)
    return found


def _whole(one: ActuatorAt, equaliser: Equaliser | None, sample_rate_hz: float) -> Floats:
    try:
        return _impulse_response(one.model, equaliser, sample_rate_hz)
    except InvalidInputError as error:
        where = "" if one.place is None else f"place {one.place}: "
        raise InvalidInputError(f"{where}{error}") from error


@lru_cache(maxsize=64)
def _impulse_response(
    model: Actuator, equaliser: Equaliser | None, sample_rate_hz: float
) -> Floats:
    """Impulse response, (_LENGTH,); what lies before time 0 stands at the end."""
    frequency_hz = np.arange(_LENGTH // 2 + 1) * sample_rate_hz / _LENGTH
    response = model.response(frequency_hz)
    if equaliser is not None:
        response = response * equaliser.filter(model, frequency_hz)
    # Nothing was measured on the skin above the band; a sharp end would ring for ever.
    half_hz = 0.5 * sample_rate_hz
    top_hz = min(BAND_HZ[1], _OF_HALF * half_hz)
    beyond = np.clip((frequency_hz - top_hz) / (half_hz - top_hz), 0.0, 1.0)
    fall = 0.5 * (1.0 + np.cos(np.pi * beyond))
    found: Floats = scipy.fft.irfft(response * fall, _LENGTH)
    return found


def _reach(side: Floats, whole: Floats) -> int:
    """Samples from time 0 on until next to nothing is left of one side."""
    left = np.cumsum(np.square(side)[::-1])[::-1]
    return int(np.count_nonzero(left > _LEFT_OUT * np.square(whole).sum()))


def _refuse_ringing(one: ActuatorAt, kept: Floats, whole: Floats) -> None:
    energy = float(np.square(whole).sum())
    beyond = energy - float(np.square(kept).sum())
    if not beyond <= _MOST_BEYOND * energy:
        where = "" if one.place is None else f"Place {one.place}: the"
        raise InvalidInputError(
            f"{where or 'The'} actuator {quoted(one.actuator or one.model.title)} rings for longer "
            f"than {LONGEST_S:g} s, so that nothing can be predicted through it. Give it damping, "
            "or an equaliser."
        )
