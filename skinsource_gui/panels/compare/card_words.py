"""What is said of snapshots."""

from collections.abc import Sequence

from skinsource.base.decibels import FLOOR_DB
from skinsource.base.quoting import printable
from skinsource.design.comparing import EDITED, alike, gain_words, louder, loudest_db
from skinsource.design.labels import short_limb_title
from skinsource.studies import scenes
from skinsource_gui.compared import LEVELS_MATCHED, Compared, alike_in_level, gain_db, matched_text
from skinsource_gui.widgets.fields.level_text import minus

#: Levels that differ by less are shown as the same.
LEAST_DB = 0.05

_UNIT = "dB re 1 m/s²"


def played_db(compared: Compared) -> float | None:
    """Level of the loudest output of a snapshot as it is shown, dB; None: not known."""
    if compared.values is None:
        return None
    stored = loudest_db(compared.values["output_levels_db"])
    return stored if stored <= FLOOR_DB else stored + gain_db(compared)


def level_words(compared: Compared) -> str:
    """Level of the loudest output, "−12.3 dB"; "…" while it is not known."""
    level = played_db(compared)
    if level is None:
        return "–" if compared.problem else "…"
    return "silent" if level <= FLOOR_DB else minus(f"{level:z.1f} dB")


def title(compared: Compared) -> str:
    """What a sentence calls it."""
    number = compared.snapshot.number
    return "edited" if number == EDITED else f"snapshot {number}"


def matching_words(compared: Sequence[Compared], *, matched: bool) -> str:
    """By what quantity the designs are alike, and how much of it they have."""
    known = [one for one in compared if played_db(one) is not None]
    if len(known) < 2:
        return ""
    if not matched:
        return "As loud as they were stored"
    if not alike_in_level(compared, matched=matched):
        name = title(compared[0])
        why = "cannot be predicted" if compared[0].problem else "is silent"
        return f"{name[:1].upper()}{name[1:]} {why}: levels cannot be matched to it"
    return f"Alike at the loudest output: {level_words(known[0])[:-3]} {_UNIT}"


def difference_words(present: Compared, other: Compared, *, matched: bool) -> tuple[str, str]:
    """What stands above and below a map of their difference."""
    name = title(present)
    heading = f"{name[:1].upper()}{name[1:]} minus {title(other)}"
    words = "dB, as stored"
    if matched:
        words = f"dB, {matched_text((other, present)) or LEVELS_MATCHED}"
    mine, theirs = (one.snapshot.design.limb for one in (present, other))
    if mine == theirs:
        return heading, words
    return heading, f"{words}, {short_limb_title(mine)} minus {short_limb_title(theirs)}"


def equal_words(present: Compared, other: Compared) -> tuple[str, str]:
    """What stands above and below the map of two that make no difference: in what they agree."""
    name = title(present)
    heading = f"{name[:1].upper()}{name[1:]} and {title(other)} are equal"
    mine, theirs = present.snapshot, other.snapshot
    if mine.design == theirs.design:
        return heading, "dB, the same inputs, scaling and limb"
    if alike(louder(mine.design, present.gain), louder(theirs.design, other.gain)):
        return heading, "dB, the same inputs once levels match"
    return heading, "dB, the same levels by other inputs"


def sentence(compared: Compared, *, present: bool) -> str:
    """All that a card shows, to be read aloud."""
    name = title(compared)
    gain = gain_words(compared.gain)
    parts = [
        f"{name[:1].upper()}{name[1:]}",
        printable(scenes.title_of(compared.snapshot.design)).strip(),
        f"loudest output {level_words(compared)}",
        f"shown {gain} to match" if gain else "",
        "in the window" if present else "",
        compared.problem,
        compared.left_out,
    ]
    return ", ".join(part for part in parts if part)
