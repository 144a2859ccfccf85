"""Options of an exported stimulus: its channels, its part of time, its ends, its full scale."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from skinsource.base.arguments import brief, one_of, real_number
from skinsource.base.errors import InvalidInputError

#: What has a channel of its own.
Per = Literal["place", "input"]
#: Ids of inputs or clips, or numbers of channels.
Numbers = tuple[int, ...]
#: Asks for no actuator, rig or equaliser, not even for that of the design.
Nothing = Literal["none"]


@brief
@dataclass(frozen=True, slots=True, kw_only=True)
class StimulusOptions:
    """How a stimulus is prepared for a file; by default nothing is added to it.

    Attributes
    ----------
    per
        ``"place"``: one channel for each place in use; ``"input"``: one for each input.
    one_file_per_input
        A file of one channel for each input, PATH with ``_input-2`` before its ending; all have
        the same full scale.
    inputs, clips
        Ids of the inputs, or clips, that take part; None: all that are audible.
    from_s, to_s
        Part of the time of the design; None: from its beginning, or to its end.
    fade_in_s, fade_out_s
        Fades at the ends of that part.
    lead_in_s, tail_s
        Silence before and after it, where it may ring; None: 0.1 s with an equaliser, else none.
    sync
        Whether a last channel marks time 0, or ``from_s``, with a pulse at full scale.
    channel_map
        For each output of the device the channel that it gets, 0 for none; (): in their order.
    full_scale
        Drive that full scale stands for, in its unit; None: the largest sample.
    dither_seed
        Seed of dither where whole numbers are written; None: no dither.
    accept_loss
        Whether it is written even if a channel loses more than 1 dB of its energy at the rate.
    people
        Whether the sidecar has the range between people, see `skinsource.people.levels`.
    choices
        Options of the format: ``{"samples": "pcm24"}``.
    """

    per: Per = "place"
    one_file_per_input: bool = False
    inputs: Numbers | None = None
    clips: Numbers | None = None
    from_s: float | None = None
    to_s: float | None = None
    fade_in_s: float = 0.0
    fade_out_s: float = 0.0
    lead_in_s: float | None = None
    tail_s: float | None = None
    sync: bool = False
    channel_map: Numbers = ()
    full_scale: float | None = None
    dither_seed: int | None = None
    accept_loss: bool = False
    people: bool = False
    choices: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        one_of("per", self.per, ("place", "input"))
        for name in ("inputs", "clips", "channel_map"):
            value = getattr(self, name)
            if value is not None:
                object.__setattr__(self, name, tuple(value))
        if self.full_scale is not None:
            expected = "a positive number in the unit of the drive"
            least = 1e-30
            real_number("full_scale", self.full_scale, expected, least=least, most=1e30)
        if self.one_file_per_input and self.channel_map:
            raise InvalidInputError(
                "channel_map is for one file, and file_per_input writes several. Remove one of "
                "them."
            )
