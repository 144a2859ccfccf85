"""All channels of a set-up."""

from collections import Counter
from dataclasses import dataclass

from skinsource import fields
from skinsource.errors import InvalidInputError
from skinsource.fields import ListSpec, RecipeSpec, TextSpec
from skinsource.quoting import quoted
from skinsource.rigs.channel import RigChannel

MAX_CHANNELS = 256
TITLE = TextSpec(label="Title", longest=100, one_line=True)
NOTE = TextSpec(label="Note", longest=5000)
CHANNELS = ListSpec(
    label="Channels",
    of=RecipeSpec(label="Channel", kinds=lambda: (RigChannel,)),
    most=MAX_CHANNELS,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Rig:
    """What a laboratory has on its table.

    Attributes
    ----------
    title, note
        Words for it.
    channels
        No place and no output of a device twice.
    """

    title: str = fields.text("", TITLE)
    note: str = fields.text("", NOTE)
    channels: tuple[RigChannel, ...] = fields.field(CHANNELS, ())

    def __post_init__(self) -> None:
        fields.check(self)
        places = Counter(one.place for one in self.channels)
        for place, count in places.items():
            if count > 1:
                raise InvalidInputError(
                    f"Rig.channels has place {place} {count} times, expected once; remove one"
                )
        outputs = Counter((one.device, one.output) for one in self.channels)
        for (device, output), count in outputs.items():
            if count > 1:
                raise InvalidInputError(
                    f"Rig.channels has output {output} of device {quoted(device)} {count} times, "
                    "expected once; wire each place to its own"
                )

    def channel_of(self, place: int) -> RigChannel | None:
        """The channel of an input place; None where nothing is wired to it."""
        return next((one for one in self.channels if one.place == place), None)
