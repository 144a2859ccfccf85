"""What a design is predicted through: the actuators at its places, and what makes their volts."""

from collections import Counter
from dataclasses import dataclass
from functools import lru_cache
from math import ceil, log2

import numpy as np
import scipy

from skinsource.actuators.actuator import Actuator
from skinsource.actuators.catalog import MODEL, Model
from skinsource.actuators.equalising import (
    EQUALISERS,
    Equaliser,
    PolePairReplacement,
    RegularisedInverse,
    followed_band,
)
from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.published import BAND_HZ, MOST_PLACES, Band
from skinsource.base.quoting import quoted
from skinsource.specs import fields
from skinsource.specs.numbers import ListSpec, ModelSpec, NumberSpec, OptionalSpec
from skinsource.specs.spec import SwitchSpec, TextSpec

PLACE = OptionalSpec(
    label="Place",
    of=NumberSpec(label="Place", minimum=1, maximum=MOST_PLACES, whole=True),
    hint="None: all places that have no actuator of their own",
)
NAME = TextSpec(label="Actuator", longest=100, one_line=True)
ACTUATORS = ListSpec(
    label="Actuators",
    of=ModelSpec(label="Actuator", kinds=lambda: (ActuatorAt,)),
    most=256,
)
EQUALISER = OptionalSpec(
    label="Equaliser", of=ModelSpec(label="Equaliser", kinds=lambda: EQUALISERS)
)
RIG = TextSpec(label="Rig", longest=100, one_line=True)
ON = SwitchSpec(label="Predict through the actuator")


@dataclass(frozen=True, slots=True, kw_only=True)
class ActuatorAt:
    """An actuator at a place.

    Attributes
    ----------
    place
        Input place of the limb; None: all places that have none of their own.
    actuator
        What it is called.
    model
        How it moves.
    """

    place: int | None = fields.field(PLACE, None)
    actuator: str = fields.text("", NAME)
    model: Model = fields.field(MODEL)

    def __post_init__(self) -> None:
        fields.check(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class Actuation:
    """Actuators with their models, so that a design predicts the same wherever it is opened.

    Limits are no part of it: they belong to a rig.

    Attributes
    ----------
    actuators
        At most one for each place, and one for all others.
    equaliser
        What makes volts of the drives, which are then accelerations in m/s² that the contactor
        shall make; None: nothing does, and drives are volts.
    rig
        Title of the rig that it was taken from, or "".
    on
        Whether predictions go through it; off, it is only remembered.
    """

    actuators: tuple[ActuatorAt, ...] = fields.field(ACTUATORS)
    equaliser: RegularisedInverse | PolePairReplacement | None = fields.field(EQUALISER, None)
    rig: str = fields.text("", RIG)
    on: bool = fields.switch(True, ON)

    def __post_init__(self) -> None:
        fields.check(self)
        twice = [
            place
            for place, n in Counter(actuator.place for actuator in self.actuators).items()
            if n > 1
        ]
        if twice:
            words = "all other places" if twice[0] is None else f"place {twice[0]}"
            raise InvalidInputError(
                f"Actuation.actuators has {words} twice, expected once; remove one"
            )
        if not self.actuators:
            raise InvalidInputError("Actuation.actuators is empty, expected at least one actuator")

    def at(self, place: int) -> ActuatorAt:
        """The actuator at a place.

        Raises
        ------
        InvalidInputError
            There is none.
        """
        for wanted in (place, None):
            for actuator in self.actuators:
                if actuator.place == wanted:
                    return actuator
        rig = f"the rig {self.rig}" if self.rig else "the actuators that are predicted through"
        raise InvalidInputError(
            f"Place {place} has no actuator among {rig}. Move or mute what plays there, choose "
            "another rig, or switch off 'Predict through the actuator'."
        )

    @property
    def title(self) -> str:
        """The rig, or the actuator: "Example voice coil"."""
        names = list(
            dict.fromkeys(actuator.actuator or actuator.model.title for actuator in self.actuators)
        )
        return self.rig or (names[0] if len(names) == 1 else f"{len(names)} actuators")

    @property
    def words(self) -> str:
        """What it is, in a few words: "Example voice coil, regularised inverse"."""
        how = "no equaliser" if self.equaliser is None else _lower(self.equaliser.title)
        return f"{self.title}, {how}"


def _lower(words: str) -> str:
    return f"{words[:1].lower()}{words[1:]}"


# What equaliser and actuator make of a drive, as one impulse response at the rate of the limb.

# Twelve seconds at the rate of the published limbs: what rings longer than that is refused anyway.
_LENGTH = 2**14
#: Longest ringing that is kept before a drive begins and after it ends, as in exports.
LONGEST_S = 0.5
# Energy that is left out at each end where it ends sooner, and what may be beyond the longest.
_LEFT_OUT, _MOST_BEYOND = 1e-10, 1e-4
# At high rates it lasts so many times the longest ringing, at least.
_OF_LONGEST = 4.0


@dataclass(frozen=True, slots=True, eq=False)
class Transfer:
    """From a drive to the acceleration of the contactor.

    Attributes
    ----------
    samples : (n,)
        Impulse response: m/s² for each unit of the drive, with nothing above the band of the
        limb at full gain.
    lead
        Samples of it that lie before time 0: an equaliser without delay swings before it starts.
    """

    samples: Floats
    lead: int


def transfers_of(
    actuation: Actuation, sample_rate_hz: float, band_hz: Band | None = BAND_HZ
) -> dict[int | None, Transfer]:
    """Transfers by place, None for all other places; all of one length and lead.

    Parameters
    ----------
    actuation
        Actuators and the equaliser before them.
    sample_rate_hz, band_hz
        Of the limb; None: its band is not known, see
        `skinsource.actuators.equalising.followed_band`.

    Raises
    ------
    InvalidInputError
        An actuator does not move in the band, or rings for longer than half a second.
    """
    band = followed_band(band_hz, sample_rate_hz)
    whole = {
        actuator.place: _whole(actuator, actuation.equaliser, sample_rate_hz, band)
        for actuator in actuation.actuators
    }
    length = _length_at(sample_rate_hz)
    lead = max(_reach(row[: -length // 2 : -1], row) for row in whole.values())
    tail = max(_reach(row[: length // 2], row) for row in whole.values())
    most = int(LONGEST_S * sample_rate_hz)
    lead, tail = min(lead, most), min(tail, most)
    transfers = {}
    for actuator in actuation.actuators:
        row = whole[actuator.place]
        kept = np.concatenate((row[length - lead :], row[:tail]))
        _refuse_ringing(actuator, kept, row)
        kept.flags.writeable = False
        transfers[actuator.place] = Transfer(kept, lead)
    return transfers


def _length_at(sample_rate_hz: float) -> int:
    """Samples of what is computed before it is cut, a power of 2."""
    return max(_LENGTH, 2 ** ceil(log2(_OF_LONGEST * LONGEST_S * sample_rate_hz)))


def _whole(
    actuator: ActuatorAt, equaliser: Equaliser | None, sample_rate_hz: float, band_hz: Band
) -> Floats:
    try:
        return _impulse_response(actuator.model, equaliser, sample_rate_hz, band_hz)
    except InvalidInputError as error:
        where = "" if actuator.place is None else f"place {actuator.place}: "
        raise InvalidInputError(f"{where}{error}") from error


@lru_cache(maxsize=64)
def _impulse_response(
    model: Actuator, equaliser: Equaliser | None, sample_rate_hz: float, band_hz: Band
) -> Floats:
    """Impulse response, (length,); what lies before time 0 stands at the end."""
    length = _length_at(sample_rate_hz)
    frequency_hz = np.arange(length // 2 + 1) * sample_rate_hz / length
    response = model.response(frequency_hz)
    if equaliser is not None:
        response = response * equaliser.filter(model, frequency_hz, band_hz)
    # Nothing was measured on the skin above the band; a sharp end would ring for ever.
    half_hz, top_hz = 0.5 * sample_rate_hz, band_hz[1]
    beyond = np.clip((frequency_hz - top_hz) / (half_hz - top_hz), 0.0, 1.0)
    fall = 0.5 * (1.0 + np.cos(np.pi * beyond))
    impulse_response: Floats = scipy.fft.irfft(response * fall, length)
    return impulse_response


def _reach(side: Floats, whole: Floats) -> int:
    """Samples from time 0 on until next to nothing is left of one side."""
    left = np.cumsum(np.square(side)[::-1])[::-1]
    return int(np.count_nonzero(left > _LEFT_OUT * np.square(whole).sum()))


def _refuse_ringing(actuator: ActuatorAt, kept: Floats, whole: Floats) -> None:
    energy = float(np.square(whole).sum())
    beyond = energy - float(np.square(kept).sum())
    if not beyond <= _MOST_BEYOND * energy:
        where = "" if actuator.place is None else f"Place {actuator.place}: the"
        raise InvalidInputError(
            f"{where or 'The'} actuator {quoted(actuator.actuator or actuator.model.title)} rings for longer "
            f"than {LONGEST_S:g} s, so that nothing can be predicted through it. Give it damping, "
            "or an equaliser."
        )
