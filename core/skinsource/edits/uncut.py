"""Why clips cannot be cut in two at a time."""

from collections.abc import Sequence

from skinsource.clips import Clip


def why_uncut(chosen: Sequence[Clip], at_s: float, same_s: float) -> str:
    """Why a time cuts none of some clips; times closer than ``same_s`` are the same."""
    whose, where = ("The", "it") if len(chosen) == 1 else ("A", "one of them")
    found = f"None of the selected clips plays at {at_s:.6g} s"
    for verb, attribute in (("begins", "onset_s"), ("ends", "end_s")):
        if any(abs(getattr(one, attribute) - at_s) <= same_s for one in chosen):
            found = f"{whose} selected clip {verb} at {at_s:.6g} s: there is nothing to split"
    return f"{found}; put the playhead inside {where}."
