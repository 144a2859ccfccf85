"""What a design is predicted through: the actuators at its places, and what makes their volts."""

from collections import Counter
from dataclasses import dataclass

from skinsource import fields
from skinsource.actuators import MODEL, Model
from skinsource.equalising import EQUALISERS, PolePairReplacement, RegularisedInverse
from skinsource.errors import InvalidInputError
from skinsource.fields import ListSpec, NumberSpec, OptionalSpec, RecipeSpec, SwitchSpec, TextSpec
from skinsource.limb import MOST_PLACES

PLACE = OptionalSpec(
    label="Place",
    of=NumberSpec(label="Place", minimum=1, maximum=MOST_PLACES, whole=True),
    hint="None: all places that have no actuator of their own",
)
NAME = TextSpec(label="Actuator", longest=100, one_line=True)
ACTUATORS = ListSpec(
    label="Actuators",
    of=RecipeSpec(label="Actuator", kinds=lambda: (ActuatorAt,)),
    most=256,
)
EQUALISER = OptionalSpec(
    label="Equaliser", of=RecipeSpec(label="Equaliser", kinds=lambda: EQUALISERS)
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
            place for place, n in Counter(one.place for one in self.actuators).items() if n > 1
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
            for one in self.actuators:
                if one.place == wanted:
                    return one
        rig = f"the rig {self.rig}" if self.rig else "the actuators that are predicted through"
        raise InvalidInputError(
            f"Place {place} has no actuator among {rig}. Move or mute what plays there, choose "
            "another rig, or switch off 'Predict through the actuator'."
        )

    @property
    def title(self) -> str:
        """The rig, or the actuator: "Example voice coil"."""
        names = list(dict.fromkeys(one.actuator or one.model.title for one in self.actuators))
        return self.rig or (names[0] if len(names) == 1 else f"{len(names)} actuators")

    @property
    def words(self) -> str:
        """What it is, in a few words: "Example voice coil, regularised inverse"."""
        how = "no equaliser" if self.equaliser is None else _lower(self.equaliser.title)
        return f"{self.title}, {how}"


def _lower(words: str) -> str:
    return f"{words[:1].lower()}{words[1:]}"
