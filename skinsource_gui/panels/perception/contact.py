"""What ISO 5349-1 makes of the contacts, in words and as a table."""

#: Weighted RMS of each place in use, m/s²; None: drives are no accelerations of the probe.
Weighted = tuple[tuple[int, float], ...] | None

_NO_WEIGHTED = "Wh: only where drives are accelerations of the probe"
_MOST_SAID = 3
# Word joiners: a line does not break at the slash.
_UNIT = "m\u2060/\u2060s²"


def contact_words(weighted: Weighted, *, as_stored: bool = False) -> str:
    """A sentence; of many places it says the largest, and of the skin elsewhere nothing.

    ``as_stored``: what else is shown has a gain that these have not.
    """
    if weighted is None:
        return _NO_WEIGHTED
    if not weighted:
        return ""
    if len(weighted) <= _MOST_SAID:
        said = f"{_listed(weighted, ', ')} RMS"
    else:
        place, most = max(weighted, key=lambda one: one[1])
        said = f"largest {most:.3g} {_UNIT} RMS at place {place}, of {len(weighted)} places"
    stored = ", with the amplitudes that were stored" if as_stored else ""
    return f"ISO 5349-1 Wh, a health weighting, not perception, of the probe itself: {said}{stored}"


def contact_list(weighted: Weighted) -> str:
    """All places, one a line; "" where the sentence says them all."""
    if weighted is None or len(weighted) <= _MOST_SAID:
        return ""
    return "Wh, RMS\n" + _listed(weighted, "\n")


def contact_table(weighted: Weighted) -> str:
    """All places for a spreadsheet, below a line that is empty; "" where there are none."""
    if not weighted:
        return ""
    lines = [f"{place}\t{value!r}" for place, value in weighted]
    return "\n".join(["", "place\tiso_5349_1_wh_rms_m_per_s2", *lines]) + "\n"


def _listed(weighted: tuple[tuple[int, float], ...], between: str) -> str:
    return between.join(f"place {place}: {value:.3g} {_UNIT}" for place, value in weighted)
