"""Why it became silent."""

from dataclasses import dataclass
from typing import Literal

from skinsource.decibels import decibels

Reason = Literal["end", "stopped", "panic", "limit", "broken"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Ending:
    """Why nothing is played any more.

    Attributes
    ----------
    reason
        ``"end"``: all has been played.  ``"stopped"``, ``"panic"``: somebody said so.
        ``"limit"``: a sample would have passed full scale.  ``"broken"``: a sample was no finite
        number.
    output, name
        Of the first such sample: number of the output, from 1, and what it plays; 0 and "" where
        no sample is to blame.
    peak
        Its absolute value, 1 is full scale.
    gain_db
        The gain at that sample.
    """

    reason: Reason
    output: int = 0
    name: str = ""
    peak: float = 0.0
    gain_db: float = 0.0

    @property
    def sentence(self) -> str:
        """What to tell, and what to do next; "" where it is what was asked for."""
        where = f"output {self.output}{f' ({self.name})' if self.name else ''}"
        if self.reason == "limit":
            over_db = float(decibels(self.peak))
            return (
                f"Stopped: {where} would have passed full scale by {over_db:.1f} dB. "
                f"Turn the gain down to {self.gain_db - over_db - 0.05:.1f} dB or less, or lower "
                "the amplitude."
            )
        if self.reason == "broken":
            return f"Stopped: {where} was to play something that is no number."
        if self.reason == "panic":
            return "Stopped at once. The gain is back at where it starts."
        return ""
