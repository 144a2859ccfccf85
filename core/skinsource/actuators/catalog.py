"""The actuators that the library ships, one file each in ``data/actuators``.

A profile holds the model of an actuator, where its numbers come from, and its limits.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from skinsource.actuators.actuator import ResponseShape
from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.models import Piezo, RecoilVoiceCoil, VoiceCoil
from skinsource.actuators.prediction import Limits, Thermal
from skinsource.base.arguments import one_of
from skinsource.base.assets import data_folder
from skinsource.base.errors import InvalidInputError
from skinsource.base.files import read_bytes
from skinsource.base.json_text import MAX_TEXT_BYTES
from skinsource.base.quoting import quoted
from skinsource.specs import fields, models
from skinsource.specs.codec import from_plain_text
from skinsource.specs.numbers import ModelSpec, OptionalSpec
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
