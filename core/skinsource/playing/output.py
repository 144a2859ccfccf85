"""Where it is played: what one machine knows of its device and its actuators."""

import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass

from skinsource.arguments import real_number, whole_number
from skinsource.errors import InvalidInputError
from skinsource.limb import MOST_PLACES
from skinsource.quoting import quoted

#: Rates that devices are asked for.
RATES_HZ = (8_000, 16_000, 32_000, 44_100, 48_000, 88_200, 96_000, 176_400, 192_000)
#: Outputs of the largest device that is thought of.
MOST_OUTPUTS = 128
SHORTEST_LATENCY_S, LONGEST_LATENCY_S = 0.002, 0.5
LEAST_SHIFT_HZ, MOST_SHIFT_HZ = 50.0, 2000.0

_LOWEST_RATE_HZ, _HIGHEST_RATE_HZ = 4_000, 384_000
_LONGEST_NAME = 400


@dataclass(frozen=True, slots=True, kw_only=True)
class Output:
    """A device, and which of its outputs drives which place.

    Attributes
    ----------
    device, host_api
        Names, as the machine has them; ``""``: what the system plays on.
    sample_rate_hz
        Rate that the device is asked for.
    latency_s
        Delay that it is asked for; it may take more.
    outputs
        Pairs of an input place and the output, from 1, that drives its actuator.  Other places
        take the free outputs, in their order.
    stand_in
        Whether it is made audible on two channels, for people without actuators.
    shift_hz
        How far the stand-in shifts all frequencies up.
    """

    device: str = ""
    host_api: str = ""
    sample_rate_hz: int = 48_000
    latency_s: float = 0.02
    outputs: tuple[tuple[int, int], ...] = ()
    stand_in: bool = False
    shift_hz: float = 300.0

    def __post_init__(self) -> None:
        for name, words in (("device", self.device), ("host_api", self.host_api)):
            if not isinstance(words, str) or len(words) > _LONGEST_NAME:
                raise InvalidInputError(f"{name} is {quoted(words)}, expected a name")
        whole_number("sample_rate_hz", self.sample_rate_hz, _LOWEST_RATE_HZ, _HIGHEST_RATE_HZ)
        least_s, most_s = SHORTEST_LATENCY_S, LONGEST_LATENCY_S
        real_number("latency_s", self.latency_s, least=least_s, most=most_s)
        real_number("shift_hz", self.shift_hz, least=LEAST_SHIFT_HZ, most=MOST_SHIFT_HZ)
        for place, output in self.outputs:
            whole_number("place", place, 1, MOST_PLACES)
            whole_number("output", output, 1, MOST_OUTPUTS)
        for name, numbers in zip(
            ("place", "output"), zip(*self.outputs, strict=True), strict=False
        ):
            twice = next((one for one in numbers if numbers.count(one) > 1), None)
            if twice is not None:
                raise InvalidInputError(
                    f"{name} {twice} stands twice in the channel map, expected once: each place "
                    "has an output of its own"
                )

    def outputs_of(self, places: Iterable[int]) -> dict[int, int]:
        """Output of each of ``places``, from 1: the one in the map, else the next that is free.

        Ask with all places of a design, heard or not: what one drives then does not depend on
        whether another is muted.
        """
        wanted = tuple(dict.fromkeys(places))
        found = {place: output for place, output in self.outputs if place in wanted}
        taken = {output for _, output in self.outputs}
        free = (
            output for output in range(1, MOST_OUTPUTS + 1 + len(wanted)) if output not in taken
        )
        for place in wanted:
            if place not in found:
                found[place] = next(free)
        return found

    def to_text(self) -> str:
        """Write it down."""
        return json.dumps(asdict(self))


def output_from_text(text: str) -> Output:
    """Read what `Output.to_text` wrote.

    Raises
    ------
    InvalidInputError
        It is something else.
    """
    try:
        held = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise InvalidInputError(f"{quoted(text)} describes no output") from error
    if not isinstance(held, dict) or not set(held) <= set(Output.__slots__):
        raise InvalidInputError(f"{quoted(text)} describes no output")
    try:
        held["outputs"] = tuple((place, output) for place, output in held.get("outputs", ()))
        if not isinstance(held.get("stand_in", False), bool):
            raise TypeError("stand_in is no switch")
        return Output(**held)
    except (TypeError, ValueError) as error:
        raise InvalidInputError(f"{quoted(text)} describes no output: {error}") from error
