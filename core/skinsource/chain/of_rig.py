"""What a rig predicts through."""

from skinsource.actuators import load, names
from skinsource.chain.actuation import Actuation, ActuatorAt
from skinsource.equalising import PolePairReplacement, RegularisedInverse
from skinsource.errors import InvalidInputError
from skinsource.rigs import Rig


def actuation_of_rig(
    rig: Rig, equaliser: RegularisedInverse | PolePairReplacement | None = None
) -> Actuation:
    """Return the actuators of a rig, as they were measured, else as their models say.

    Channels of which it is not known how they move are left out: nothing is predicted there.

    Raises
    ------
    InvalidInputError
        It is not known of any.
    """
    found = []
    for one in rig.channels:
        listed = load(one.actuator) if one.actuator in names() else None
        model = one.moves_as if one.moves_as is not None else listed
        if model is not None:
            found.append(ActuatorAt(place=one.place, actuator=one.actuator, model=model))
    if not found:
        raise InvalidInputError(
            "The rig does not say how any of its actuators moves. Measure one, or name one that "
            "the library lists."
        )
    return Actuation(actuators=tuple(found), equaliser=equaliser, rig=rig.title or "rig")
