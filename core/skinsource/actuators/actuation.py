"""Actuators that the library ships, and those with an equaliser that a design goes through.

A shipped actuator is a file in ``data/actuators``: its model, where its numbers come from, and its
limits.  Actuators and equaliser of a design make one impulse response for each place, from a drive
to the acceleration of the contactor, at the sample rate of the limb.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from functools import cache, lru_cache
from math import ceil, log2

import numpy as np
import scipy

from skinsource.actuators.actuator import Actuator, ResponseShape
from skinsource.actuators.equalising import (
    EQUALISERS,
    Equaliser,
    PolePairReplacement,
    RegularisedInverse,
    followed_band,
)
from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.models import Piezo, RecoilVoiceCoil, VoiceCoil
from skinsource.actuators.prediction import Limits, Thermal
from skinsource.base.arguments import one_of
from skinsource.base.assets import data_folder
from skinsource.base.conventions import BAND_HZ, MOST_LOCATIONS, Band, Floats
from skinsource.base.errors import InvalidInputError, lowered, quoted
from skinsource.base.files import read_bytes
from skinsource.base.json_text import MAX_TEXT_BYTES
from skinsource.specs import fields, models
from skinsource.specs.codec import from_plain_text
from skinsource.specs.numbers import ListSpec, ModelSpec, NumberSpec, OptionalSpec
from skinsource.specs.spec import Address, SwitchSpec, TextSpec

#: Every kind that moves, in the order in which a user meets them.
KINDS = (VoiceCoil, RecoilVoiceCoil, Piezo, MeasuredResponse)
Model = VoiceCoil | RecoilVoiceCoil | Piezo | MeasuredResponse

MODEL: ModelSpec = ModelSpec(label="Model", kinds=lambda: KINDS)
_ANY = ModelSpec(label="Model", kinds=lambda: (*KINDS, ResponseShape))
LIMITS = ModelSpec(label="Limits", kinds=lambda: (Limits,))
THERMAL = OptionalSpec(label="Warming", of=ModelSpec(label="Warming", kinds=lambda: (Thermal,)))


@dataclass(frozen=True, slots=True, kw_only=True)
class ActuatorProfile(fields.CheckedModel):
    """An actuator as the library lists it.

    Attributes
    ----------
    title
        What a user reads.
    source
        Where the numbers come from.
    calibration
        Which of its numbers are calibrated.
    gain_calibrated
        Whether m/s² for each volt may be trusted; else only the shape of the response counts.
    model
        A model that moves, or a `ResponseShape` where too little is known for a model.
    limits, thermal
        Its limits; how it warms, where that is known.
    """

    title: str = fields.field(TextSpec(label="Title", longest=100, one_line=True))
    source: str = fields.field(TextSpec(label="Source", longest=1000))
    calibration: str = fields.field(TextSpec(label="Calibration", longest=1000))
    gain_calibrated: bool = fields.switch(False, SwitchSpec(label="Gain is calibrated"))
    model: Model | ResponseShape = fields.field(_ANY)
    limits: Limits = fields.field(LIMITS, Limits())
    thermal: Thermal | None = fields.field(THERMAL, None)

    @property
    def complete(self) -> bool:
        """Whether the model moves."""
        return not isinstance(self.model, ResponseShape)


_FORMAT, _VERSION = "skinsource actuator", 1


def names() -> tuple[str, ...]:
    """Return the names of the actuators with a complete model, which `load` returns.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(len(ss.actuators.names()))
    6
    """
    return tuple(name for name, actuator in _catalog().items() if actuator.complete)


def shape_names() -> tuple[str, ...]:
    """Return the names of the actuators of which only the response shape is known.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.actuators.shape_names()[0])
    bk-4810
    """
    return tuple(name for name, actuator in _catalog().items() if not actuator.complete)


def profile(name: str) -> ActuatorProfile:
    """Return all that is known of an actuator: its model, limits and sources.

    Raises
    ------
    InvalidInputError
        No actuator has this name.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.actuators.profile(ss.actuators.names()[0]).limits.peak_voltage_v)
    None
    """
    return _catalog()[one_of("actuator", name, tuple(_catalog()))]


def profile_of(name: str) -> ActuatorProfile | None:
    """Return all that is known of an actuator; None where the library does not list it."""
    return _catalog().get(name)


def load(name: str) -> Model:
    """Return the model of an actuator of `names`.

    Raises
    ------
    InvalidInputError
        No actuator has this name, or too little is known of it for a model.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(type(ss.actuators.load(ss.actuators.names()[0])).__name__)
    Piezo
    """
    model = profile(name).model
    if isinstance(model, ResponseShape):
        raise InvalidInputError(
            f"actuator {quoted(name)} has only a response shape; use load_shape, or choose one of "
            f"{', '.join(names())}"
        )
    return model


def load_shape(name: str) -> ResponseShape:
    """Return the response shape of an actuator of `shape_names`; it has no scale.

    Raises
    ------
    InvalidInputError
        No actuator has this name, or it has a model.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(type(ss.actuators.load_shape(ss.actuators.shape_names()[0])).__name__)
    ResponseShape
    """
    model = profile(name).model
    if not isinstance(model, ResponseShape):
        raise InvalidInputError(f"actuator {quoted(name)} has a model; use load")
    return model


@cache
def _catalog() -> dict[str, ActuatorProfile]:
    """Return the shipped profiles by name; their files do not change while the program runs."""
    folder = data_folder() / "actuators"
    profiles = {}
    for path in sorted(folder.glob("*.json")):
        tree = from_plain_text(read_bytes(path, most=MAX_TEXT_BYTES), _FORMAT, _VERSION)
        profiles[path.stem] = models.decode(tree, (ActuatorProfile,), Address())
    return profiles


PLACE = OptionalSpec(
    label="Place",
    of=NumberSpec(label="Place", minimum=1, maximum=MOST_LOCATIONS, whole=True),
    hint="None: every place without its own actuator",
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
class ActuatorAt(fields.CheckedModel):
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Actuation:
    """Actuators with their models, so that a design predicts the same wherever it is opened.

    Limits are no part of it: they belong to a rig.

    Attributes
    ----------
    actuators
        At most one for each place, and one for all others.
    equaliser
        Filter from drives to volts; drives are then accelerations of the contactor, m/s². None:
        there is no filter, and drives are volts.
    rig
        Title of the rig that it was taken from, or "".
    on
        Whether predictions go through it; if not, it is only stored.
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
            description = "all other places" if twice[0] is None else f"place {twice[0]}"
            raise InvalidInputError(
                f"Actuation.actuators has {description} twice, expected once; remove one"
            )
        if not self.actuators:
            raise InvalidInputError("Actuation.actuators is empty, expected at least one actuator")

    def at(self, place: int) -> ActuatorAt:
        """Return the actuator at a place.

        Raises
        ------
        InvalidInputError
            There is none.
        """
        for candidate in (place, None):
            for actuator in self.actuators:
                if actuator.place == candidate:
                    return actuator
        where = f"in the rig {self.rig}" if self.rig else "among the actuators of the design"
        cure = "or choose another rig"
        if self.on:
            cure = "choose another rig, or switch off 'Predict through the actuator'"
        raise InvalidInputError(
            f"Place {place} has no actuator {where}. Move or mute its inputs, {cure}."
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
        how = "no equaliser" if self.equaliser is None else lowered(self.equaliser.title)
        return f"{self.title}, {how}"


# Length of responses before they are trimmed: twelve seconds at the rate of the published limbs,
# far more than may ring.
_LENGTH = 2**14
#: Longest ringing before a drive begins and after it ends, as in exports.
LONGEST_S = 0.5
# Share of the energy that is trimmed at each end, and that may lie beyond the longest ringing.
_LEFT_OUT, _MOST_BEYOND = 1e-10, 1e-4
# At high rates responses last at least so many times the longest ringing.
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
    """Return the transfers by place, None for all other places, all of one length and lead.

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
    full_responses = {}
    for actuator in actuation.actuators:
        try:
            full_responses[actuator.place] = _impulse_response(
                actuator.model, actuation.equaliser, sample_rate_hz, band
            )
        except InvalidInputError as error:
            where = "" if actuator.place is None else f"place {actuator.place}: "
            raise InvalidInputError(f"{where}{error}") from error
    length = _length_at(sample_rate_hz)
    lead = max(_reach(row[: -length // 2 : -1], row) for row in full_responses.values())
    tail = max(_reach(row[: length // 2], row) for row in full_responses.values())
    most = int(LONGEST_S * sample_rate_hz)
    lead, tail = min(lead, most), min(tail, most)
    transfers = {}
    for actuator in actuation.actuators:
        row = full_responses[actuator.place]
        trimmed = np.concatenate((row[length - lead :], row[:tail]))
        _check_ringing(actuator, trimmed, row)
        trimmed.flags.writeable = False
        transfers[actuator.place] = Transfer(trimmed, lead)
    return transfers


def _length_at(sample_rate_hz: float) -> int:
    """Return the length of responses before they are trimmed, a power of 2."""
    return max(_LENGTH, 2 ** ceil(log2(_OF_LONGEST * LONGEST_S * sample_rate_hz)))


@lru_cache(maxsize=64)
def _impulse_response(
    model: Actuator, equaliser: Equaliser | None, sample_rate_hz: float, band_hz: Band
) -> Floats:
    """Return the impulse response, (length,); the end holds what lies before time 0."""
    length = _length_at(sample_rate_hz)
    frequency_hz = np.arange(length // 2 + 1) * sample_rate_hz / length
    response = model.response(frequency_hz)
    if equaliser is not None:
        response = response * equaliser.filter(model, frequency_hz, band_hz)
    # Nothing was measured on the skin above the band; a sharp end would ring for ever.
    half_hz, top_hz = 0.5 * sample_rate_hz, band_hz[1]
    beyond = np.clip((frequency_hz - top_hz) / (half_hz - top_hz), 0.0, 1.0)
    fall = 0.5 * (1.0 + np.cos(np.pi * beyond))
    return scipy.fft.irfft(response * fall, length)


def _reach(side: Floats, full_response: Floats) -> int:
    """Count the samples of one side from time 0 until its remaining energy is negligible."""
    left = np.cumsum(np.square(side)[::-1])[::-1]
    return int(np.count_nonzero(left > _LEFT_OUT * np.square(full_response).sum()))


def _check_ringing(actuator: ActuatorAt, trimmed: Floats, full_response: Floats) -> None:
    energy = float(np.square(full_response).sum())
    beyond = energy - float(np.square(trimmed).sum())
    if not beyond <= _MOST_BEYOND * energy:
        where = "The" if actuator.place is None else f"Place {actuator.place}: the"
        name = quoted(actuator.actuator or actuator.model.title)
        raise InvalidInputError(
            f"{where} actuator {name} rings for longer than {LONGEST_S:g} s, too long for a "
            "prediction. Add damping or an equaliser."
        )
