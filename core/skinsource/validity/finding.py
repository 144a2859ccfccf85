"""One condition, and whether a design keeps it."""

from dataclasses import dataclass
from typing import Literal

#: ``"kept"``, ``"left"``, or ``"unknown"`` where nothing can be said.
State = Literal["kept", "left", "unknown"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """A condition of the measurement.

    Attributes
    ----------
    name
        ``"band"``, ``"drive"``, ``"spacing"``, ``"noise"``, ``"limb"`` or ``"scaling"``; or
        ``"inputs"``, where some are left out because they cannot be played.
    state
        Whether the design keeps it.
    sentence
        What was found, and what it means.
    in_short
        The same where there is little room, as below a picture; "" where it is not left.  In place
        of its number stands a field such as ``"{:.0%}"``: of several designs it is a range.
    number
        That number; None where there is none.
    mend
        Name of what would mend it: ``"quieter"``, ``"band_limit"``,
        ``"probe_scaling"``, ``"deselect"``; "" where nothing does.
    factor
        What amplitudes are to be multiplied with where that mends it; else 1.
    outputs
        Those that it is about; none: it is about all.
    of_maps
        Whether it is about what maps draw between outputs, and about nothing else.
    """

    name: str
    state: State
    sentence: str
    in_short: str = ""
    number: float | None = None
    mend: str = ""
    factor: float = 1.0
    outputs: tuple[int, ...] = ()
    of_maps: bool = False


Findings = tuple[Finding, ...]


def words_of(findings: Findings) -> list[str]:
    """A line for each condition that is not kept, for the head of a file."""
    said = {"left": "CAUTION", "unknown": "unknown"}
    return [
        f"validity, {one.name}: {said[one.state]}: {one.sentence}"
        for one in findings
        if one.state in said
    ]
