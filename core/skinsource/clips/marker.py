"""A name for a time."""

from dataclasses import dataclass

from skinsource import fields
from skinsource.fields import NumberSpec, TextSpec

#: No clip begins later than 600 s, and none without effects plays longer than that.
LATEST_S = 1200.0

TIME = NumberSpec(label="Time", unit="s", minimum=0.0, maximum=LATEST_S, step=0.005)
NAME = TextSpec(label="Name", longest=100, one_line=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class Marker:
    """A name for a time of a design.

    Attributes
    ----------
    time_s
        When.
    name
        What stands there; it may be empty.
    """

    time_s: float = fields.field(TIME)
    name: str = fields.text("", NAME)

    def __post_init__(self) -> None:
        fields.check(self)
