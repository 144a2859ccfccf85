"""Which kinds of waveforms there are, for those on whom the table of kinds itself stands.

Clips hold waveforms, and one kind of waveform holds clips: so the table stands above the clips, and
tells them here what it holds.
"""

from collections.abc import Callable

from skinsource.synthesis.waveform import Waveform

Kinds = tuple[type[Waveform], ...]

_tables: list[Callable[[], Kinds]] = []


def tell_kinds(table: Callable[[], Kinds]) -> None:
    """Let ``table`` say from now on which kinds there are."""
    _tables[:] = [table]


def known_kinds() -> Kinds:
    """Every kind of waveform that there is now."""
    return _tables[0]() if _tables else ()


def first_kind() -> Waveform:
    """What is played where nothing is said: the first kind, as it is made."""
    return known_kinds()[0]()
