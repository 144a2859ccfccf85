"""Titles and explanations of choices, the same in the window, on the command line and in files.

Scripts and design files use the short names (``upstream``, ``pca``, …), which never change.
``docs/words.md`` shows all of them as a table.
"""

from dataclasses import dataclass, replace

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


#: The axes of a sensor.
TRIAD = (
    Word(
        name="x",
        title="x",
        sentence="Along the skin, in a direction that differs between sensors.",
    ),
    Word(
        name="y",
        title="y",
        sentence="Along the skin, at right angles to x, in a direction that differs between "
        "sensors.",
    ),
    Word(
        name="z",
        title="z",
        sentence="Normal to the skin at every sensor: the only axis whose sign can be compared "
        "between sensors.",
    ),
)
TRIAD_SENTENCE = (
    "Each sensor has its own axes: z is normal to the skin, x and y lie along it in directions "
    "that differ between sensors."
)

AXES = (
    *TRIAD,
    Word(name="xy", title="x, y", sentence="Motion along the skin."),
    Word(
        name="xz",
        title="x, z",
        sentence="Motion normal to the skin and in one direction along it, which differs between "
        "sensors.",
    ),
    Word(
        name="yz",
        title="y, z",
        sentence="Motion normal to the skin and in one direction along it, which differs between "
        "sensors.",
    ),
    Word(name="xyz", title="x, y, z", sentence="Motion in every direction."),
)
METHODS = (
    Word(
        name="mag",
        title="Magnitude",
        sentence="Length of the acceleration vector at each instant: never negative, and "
        "independent of how a sensor is turned.",
    ),
    Word(
        name="pca",
        title="Principal axis",
        sentence="Component along the direction in which "
        "each output varies most; its sign cannot be compared between outputs.",
    ),
    Word(
        name="rms",
        title="RMS direction",
        sentence="Component along the vector of the RMS values "
        "of the axes at each output; depends on how the sensor is turned.",
    ),
    Word(
        name="soc",
        title="Sum of components",
        sentence="Plain sum of the chosen axes; depends on how the sensor is turned.",
    ),
)
SCALINGS = (
    Word(
        name="upstream",
        title="Peak of each input",
        sentence="The amplitude of an input, in m/s², is the largest acceleration that it alone "
        "causes at any output, on any axis, as in the published toolbox.",
    ),
    Word(
        name="relative",
        title="Equal drives",
        sentence="No rescaling: strong and weak places "
        "keep their ratio; an amplitude of 1 is the measuring pulse.",
    ),
    Word(
        name="probe",
        title="Probe acceleration",
        sentence="Amplitudes are accelerations of the probe in m/s², within about 3 dB.",
    ),
)
# Sentences for a limb whose responses answer a drive of unknown unit.
_OF_DRIVES = {
    "relative": "No rescaling: strong and weak places keep their ratio; an amplitude of 1 is one "
    "unit of the drive of this limb.",
    "probe": "Amplitudes are in the unit of the drive of this limb, which is unknown.",
}
_LOUDEST = f"{LOUDEST_WINDOW_S * 1000:g} ms"
SPANS = (
    Word(
        name="record",
        title="Whole record",
        sentence="Levels are the RMS over the whole "
        "response, its silence included, as in the published toolbox: a later onset lowers "
        "them.",
    ),
    Word(
        name="loudest",
        title=f"Loudest {_LOUDEST}",
        sentence=f"Levels are the highest RMS of any {_LOUDEST}, "
        "output by output: neither onset nor silence changes them. Spectra take the loudest "
        f"{HOLD_WINDOW_S * 1e3:.0f} ms of each frequency: {_LOUDEST} tell frequencies apart that "
        f"differ by {1 / LOUDEST_WINDOW_S:.0f} Hz, {HOLD_WINDOW_S * 1e3:.0f} ms by "
        f"{1 / HOLD_WINDOW_S:.0f} Hz.",
    ),
)
#: Synthetic and published limbs; `limb_label` also finds those that a lab imported.
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
    if drive_unit_known:
        return SCALINGS
    return tuple(
        replace(word, sentence=_OF_DRIVES.get(word.name, word.sentence)) for word in SCALINGS
    )


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
