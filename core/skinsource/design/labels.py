"""Titles and explanations of choices, the same in the window, on the command line and in files.

Scripts and design files use the short names (``upstream``, ``pca``, …), which never change.
``docs/words.md`` shows all of them as a table.
"""

import tomllib
from dataclasses import dataclass

from skinsource.base.assets import data_folder
from skinsource.limbs.limb import PUBLISHED
from skinsource.limbs.own_limbs import facts_of
from skinsource.signals.loudest_window import HOLD_WINDOW_S, LOUDEST_WINDOW_S


@dataclass(frozen=True, slots=True, kw_only=True)
class Word:
    """One value that can be chosen.

    Attributes
    ----------
    name
        Name in scripts and files.
    title
        Name for people.
    sentence
        Meaning, for tooltips and help.
    """

    name: str
    title: str
    sentence: str

    @property
    def both(self) -> str:
        """Title and, where it differs, name: ``"Principal axis (pca)"``."""
        return self.title if self.title == self.name else f"{self.title} ({self.name})"


_TABLES: dict[str, dict[str, dict[str, str]]] = tomllib.loads(
    (data_folder() / "words.toml")
    .read_text("utf-8")
    .format(
        short_ms=1e3 * LOUDEST_WINDOW_S,
        long_ms=1e3 * HOLD_WINDOW_S,
        short_hz=1 / LOUDEST_WINDOW_S,
        long_hz=1 / HOLD_WINDOW_S,
    )
)
AXES, METHODS, SCALINGS, SPANS, _DRIVES = (
    tuple(Word(name=name, **texts) for name, texts in _TABLES[field].items())
    for field in ("axes", "method", "scaling", "span", "scaling_of_drives")
)
TRIAD_SENTENCE = (
    "Each sensor has its own axes: z is normal to the skin, x and y lie along it in directions "
    "that differ between sensors."
)
LIMBS = tuple(
    Word(name=name, title=facts.title, sentence=facts.sentence) for name, facts in PUBLISHED.items()
)

#: Every choice with names in files: field, title, explanation, values.
CHOICES = (
    ("limb", "Limb", "Whose hand and arm.", LIMBS),
    ("scaling", "Scaling", "What an amplitude of 1 means.", SCALINGS),
    ("axes", "Axes", "Axes of the sensors that are used. " + TRIAD_SENTENCE, AXES),
    ("method", "Method", "How several axes become one signal.", METHODS),
    ("span", "Levels", "Time over which a level is the RMS.", SPANS),
)

#: Names of the two sides of hand and arm.
BACK_SIDE, PALM_SIDE = "Back of the hand", "Palm side"


def label_of(words: tuple[Word, ...], name: str) -> Word:
    """Return the word with a short name; an unknown name is its own title.

    >>> label_of(METHODS, "pca").title
    'Principal axis'
    """
    known = {word.name: word for word in words}
    return known.get(name) or Word(name=name, title=name, sentence="")


def scalings_on(*, drive_unit_known: bool) -> tuple[Word, ...]:
    """Return the scalings with their meaning on a limb.

    Parameters
    ----------
    drive_unit_known
        See `skinsource.limbs.own_limbs.drive_unit_known`.
    """
    return SCALINGS if drive_unit_known else _DRIVES


def limb_label(name: str) -> Word:
    """Return the word of a limb, imported ones included; an unknown name is its own title."""
    facts = facts_of(name)
    return Word(name=name, title=facts.title, sentence=facts.sentence)


def short_limb_title(name: str) -> str:
    """Return a short title of a limb: that of a published one without the length.

    >>> short_limb_title("synthetic-1")
    'Synthetic 1'
    """
    title = limb_label(name).title
    return title.partition(" (")[0] if name in PUBLISHED else title


def signal_label(axes: str, method: str) -> str:
    """Name axes and method: ``"x, y, z, principal axis"``; a single axis has no method.

    >>> signal_label("z", "pca")
    'z'
    >>> signal_label("xy", "mag")
    'x, y, magnitude'
    """
    title = label_of(AXES, axes).title
    if len(axes) == 1:
        return title
    how = label_of(METHODS, method).title
    # "RMS direction" keeps its capitals.
    return f"{title}, {how[:1].lower() if how[1:2].islower() else how[:1]}{how[1:]}"


def span_label(span: str) -> str:
    """Return the name of a span within a sentence: ``"loudest 100 ms"``."""
    return label_of(SPANS, span).title.lower()


def level_label(span: str) -> str:
    """Return the name of levels over a span: ``"RMS over the whole record"``."""
    return f"RMS over the {span_label(span)}"
