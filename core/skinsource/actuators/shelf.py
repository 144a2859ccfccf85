"""The actuators that the library ships, one file each in ``data/actuators``."""

from functools import cache

from skinsource import codec
from skinsource.actuators.actuator_profile import ActuatorProfile, Model
from skinsource.actuators.response_shape import ResponseShape
from skinsource.arguments import one_of
from skinsource.codec.json_text import MAX_TEXT_BYTES
from skinsource.codec.plain_text import from_plain_text
from skinsource.errors import InvalidInputError
from skinsource.fields import Address
from skinsource.files import read_bytes
from skinsource.files.assets import data_folder
from skinsource.quoting import quoted

_FORMAT, _VERSION = "skinsource actuator", 1


def names() -> tuple[str, ...]:
    """Names of the actuators whose models are complete: `load` gives what `simulate` moves."""
    return tuple(name for name, one in _shelf().items() if one.complete)


def shape_names() -> tuple[str, ...]:
    """Names of those of which only the resonance is known: `load_shape` gives its shape."""
    return tuple(name for name, one in _shelf().items() if not one.complete)


def profile(name: str) -> ActuatorProfile:
    """All that is known of an actuator: its model, its limits, and where the numbers come from.

    Raises
    ------
    InvalidInputError
        No actuator has this name.
    """
    return _shelf()[one_of("actuator", name, tuple(_shelf()))]


def load(name: str) -> Model:
    """The model of an actuator of `names`.

    Raises
    ------
    InvalidInputError
        No actuator has this name, or too little is known of it for a model.
    """
    found = profile(name).model
    if isinstance(found, ResponseShape):
        raise InvalidInputError(
            f"actuator {quoted(name)} is known by the shape of its response only; take load_shape, "
            f"or one of {', '.join(names())}"
        )
    return found


def load_shape(name: str) -> ResponseShape:
    """The response shape of an actuator of `shape_names`; it has no scale.

    Raises
    ------
    InvalidInputError
        No actuator has this name, or it has a model.
    """
    found = profile(name).model
    if not isinstance(found, ResponseShape):
        raise InvalidInputError(f"actuator {quoted(name)} has a model; take load")
    return found


@cache
def _shelf() -> dict[str, ActuatorProfile]:
    """Shipped files do not change while the program runs."""
    folder = data_folder() / "actuators"
    found = {}
    for path in sorted(folder.glob("*.json")):
        tree = from_plain_text(read_bytes(path, most=MAX_TEXT_BYTES), _FORMAT, _VERSION)
        found[path.stem] = codec.decode(tree, (ActuatorProfile,), Address())
    return found
