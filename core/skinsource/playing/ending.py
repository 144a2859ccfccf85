"""Why it became silent."""

from dataclasses import dataclass
from math import floor, inf
from typing import Literal

Reason = Literal["end", "stopped", "panic", "limit", "broken", "rig"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Ending:
    """Why nothing is played any more.

    Attributes
    ----------
    reason
        ``"end"``: all has been played.  ``"stopped"``, ``"panic"``: somebody said so.
        ``"limit"``: a sample would have passed full scale.  ``"broken"``: a sample was no finite
        number.  ``"rig"``: a limit of the rig would have been passed.
    output, name
        Of the first such sample: number of the output, from 1, and what it plays; 0 and "" where
        no sample is to blame.  Of a rig, its limit.
    peak
        Its absolute value, 1 is full scale.
    highest_db
        The highest gain at which all of it stays within full scale.
    """

    reason: Reason
    output: int = 0
    name: str = ""
    peak: float = 0.0
    highest_db: float = 0.0

    @property
    def sentence(self) -> str:
        """What to tell, and what to do next; "" where it is what was asked for."""
        where = f"output {self.output}{f' ({self.name})' if self.name else ''}"
        if self.reason == "limit":
            # Rounded down, so that what is said is enough.
            most_db = floor(10.0 * self.highest_db) / 10.0
            return (
                f"Stopped: {where} would have passed full scale. Turn the gain down to "
                f"{most_db:.1f} dB or less, or lower the amplitude."
            ).replace("-", "\u2212")
        if self.reason == "rig":
            what = f"Stopped: a limit of the rig would have been passed ({self.name})."
            if self.highest_db == -inf:
                return f"{what} Shorten what is played, or change the rig."
            most_db = floor(10.0 * self.highest_db) / 10.0
            return (
                f"{what} Turn the gain down to {most_db:.1f} dB or less, or lower the amplitude."
            ).replace("-", "\u2212")
        if self.reason == "broken":
            return f"Stopped: {where} was to play something that is no number."
        if self.reason == "panic":
            return "Stopped at once. The gain is back at where it starts."
        return ""
