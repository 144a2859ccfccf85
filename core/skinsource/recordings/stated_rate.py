"""What the lines before a table say about its sample rate."""

import re
from collections.abc import Sequence

from skinsource.recordings import limits

_NUMBER = r"(?P<number>\d[\d.,]*(?:e[+-]?\d+)?)\s*(?P<unit>k?hz\b)?"
_BETWEEN = r"\s*(?:\[?\(?hz\)?\]?)?\s*[:=,;\t ]\s*"
# "Sample rate", "fs", and "rate" where nothing says of what.
_NAMED = re.compile(
    rf"(?:(?<![a-z])(?:sampl\w*[ _-]*(?:rate|freq\w*)|fs)|^[\W_]*rate){_BETWEEN}{_NUMBER}",
    re.IGNORECASE,
)
# "Samples: 5000" counts them; "Sampling: 5000 Hz" does not.
_SAMPLING = re.compile(rf"(?<![a-z])sampl\w*{_BETWEEN}{_NUMBER}", re.IGNORECASE)


def stated_rate_hz(lines: Sequence[str], decimal: str) -> float | None:
    """The first rate that one of the lines states; None where none does.

    Parameters
    ----------
    lines
        Those before the numbers.
    decimal
        Of the numbers below, "." or ",": the other one parts thousands, as in 48,000 Hz.
    """
    for line in lines:
        named, sampling = _NAMED.search(line), _SAMPLING.search(line)
        found = named or (sampling if sampling and sampling["unit"] else None)
        rate_hz = None if found is None else _hz(found["number"], found["unit"] or "", decimal)
        if rate_hz is not None and limits.LEAST_RATE_HZ <= rate_hz <= limits.MOST_RATE_HZ:
            return rate_hz
    return None


def _hz(number: str, unit: str, decimal: str) -> float | None:
    kilo, plain = unit.lower() == "khz", number.rstrip(".,")
    parting = "," if decimal == "." else "."
    if not kilo and re.fullmatch(rf"\d{{1,3}}(\{parting}\d{{3}})+(\{decimal}\d+)?", plain):
        plain = plain.replace(parting, "")
    try:
        return float(plain.replace(",", ".")) * (1000.0 if kilo else 1.0)
    except ValueError:  # more than one point: whatever it is, it is no rate
        return None
