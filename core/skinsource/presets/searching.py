"""Finding presets by words."""

from collections.abc import Iterable

from skinsource.presets.shelf import Entry


def matching(entries: Iterable[Entry], words: str, tag: str = "") -> tuple[Entry, ...]:
    """Entries that hold every one of ``words``, and have the ``tag`` where one is given.

    A word is looked for in name, tags, description and source, in capitals or not.  First come
    those with all words in their names, then those with all in names and tags, then the others;
    otherwise they stay in their order.
    """
    wanted = words.casefold().split()
    ranked = [
        (_rank(entry, wanted), entry) for entry in entries if not tag or tag in entry.preset.tags
    ]
    found = sorted(((rank, entry) for rank, entry in ranked if rank < _NONE), key=_first)
    return tuple(entry for _, entry in found)


_NONE = 3


def _first(pair: tuple[int, Entry]) -> int:
    return pair[0]


def _rank(entry: Entry, wanted: list[str]) -> int:
    preset = entry.preset
    name = preset.name.casefold()
    tagged = "\n".join((name, *preset.tags)).casefold()
    everything = "\n".join((tagged, preset.description, preset.source)).casefold()
    for rank, text in enumerate((name, tagged, everything)):
        if all(word in text for word in wanted):
            return rank
    return _NONE
