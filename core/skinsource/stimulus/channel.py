"""One channel of a stimulus."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Channel:
    """What goes to one actuator, or to whatever else is wired to an output.

    Attributes
    ----------
    number
        Its place among the channels, from 1.
    place
        Input place of the actuator; None: it drives no actuator (sync, or left silent).
    title
        Words for it.
    inputs
        Ids of the inputs of the design that it plays.
    loss_db
        How much of its energy does not reach the sample rate.
    """

    number: int
    place: int | None
    title: str
    inputs: tuple[int, ...] = ()
    loss_db: float = 0.0
