"""The 20 input places and the 72 output places of the published limbs: names, sides and regions.

Limbs that a lab imported have places of their own, which `input_name` and `output_name` know.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from skinsource.base.errors import InvalidInputError
from skinsource.base.measurement_conditions import N_OUTPUTS, check_input_location
from skinsource.base.quoting import quoted
from skinsource.limbs.own_limbs import facts_of

Contact = Literal["in-axis", "perpendicular"]
Side = Literal["dorsal", "volar"]

#: Digits from the thumb to the little finger.
DIGITS = ("I", "II", "III", "IV", "V")
#: Regions from the fingertips to the elbow; knuckles and the back of the hand are "hand".
REGIONS = (*(f"digit {digit}" for digit in DIGITS), "hand", "wrist", "forearm", "elbow")
#: Regions beyond the wrist.
ARM_REGIONS = ("wrist", "forearm", "elbow")


@dataclass(frozen=True, slots=True, kw_only=True)
class InputPlace:
    """Where an actuator touches the palm side.

    Attributes
    ----------
    number
        1 to 20.
    name, short_name
        For tooltips ("Digit II, tip") and for narrow lists ("II tip").
    contact
        "in-axis": pushes along the digit; "perpendicular": pushes into the skin.
    region
        One of `REGIONS`.
    """

    number: int
    name: str
    short_name: str
    contact: Contact
    region: str


@dataclass(frozen=True, slots=True, kw_only=True)
class OutputPlace:
    """Where an accelerometer sits.

    Attributes
    ----------
    number
        1 to 72.
    name, short_name
        For tooltips ("Digit II, beside the nail, radial") and for narrow lists.
    side
        "dorsal", or "volar" for 61 to 66.
    region
        One of `REGIONS`.
    """

    number: int
    name: str
    short_name: str
    side: Side
    region: str


def _input_places() -> tuple[InputPlace, ...]:
    rows: list[tuple[str, str, Contact, str]] = []
    on_digits: tuple[tuple[str, str, Contact], ...] = (
        ("tip, along the digit", "tip", "in-axis"),
        ("pad", "pad", "perpendicular"),
        ("base", "base", "perpendicular"),
    )
    for name, short_name, contact in on_digits:
        for digit in DIGITS:
            rows.append((f"Digit {digit}, {name}", f"{digit} {short_name}", contact, digit))
    for name, short_name in (
        ("Palm, below the gap of digits III and IV", "distal palm"),
        ("Palm, below digit II at the ball of the thumb", "radial palm"),
        ("Palm, centre", "palm centre"),
        ("Palm, little finger side", "ulnar palm"),
        ("Palm, middle of its base", "palm base"),
    ):
        rows.append((name, short_name, "perpendicular", "hand"))
    return tuple(
        InputPlace(
            number=number,
            name=name,
            short_name=short_name,
            contact=contact,
            region=region if region == "hand" else f"digit {region}",
        )
        for number, (name, short_name, contact, region) in enumerate(rows, start=1)
    )


# Outputs of digits II to V: beside the nail (ulnar, radial), middle phalanx (ulnar, radial),
# proximal phalanx, knuckle.
_DIGIT_OUTPUTS = {
    "V": (1, 2, 3, 4, 6, 5),
    "IV": (10, 11, 12, 13, 15, 14),
    "III": (19, 20, 21, 22, 24, 23),
    "II": (28, 29, 30, 31, 33, 32),
}
# The same order: name, short name, whether the place belongs to the digit or to the hand.
_ON_DIGIT = (
    ("beside the nail, ulnar", "nail uln.", True),
    ("beside the nail, radial", "nail rad.", True),
    ("middle phalanx, ulnar", "middle uln.", True),
    ("middle phalanx, radial", "middle rad.", True),
    ("proximal phalanx", "proximal", True),
    ("knuckle", "knuckle", False),
)
# Number: name, short name, region.
_OTHER_OUTPUTS = {
    41: ("Digit I, distal phalanx", "I distal", "digit I"),
    42: ("Digit I, proximal phalanx", "I proximal", "digit I"),
    8: ("Back of the hand, below knuckle V", "hand V", "hand"),
    17: ("Back of the hand, below knuckle IV", "hand IV", "hand"),
    26: ("Back of the hand, below knuckle III", "hand III", "hand"),
    35: ("Back of the hand, below knuckle II", "hand II", "hand"),
    37: ("Back of the hand, first web space", "first web", "hand"),
    7: ("Back of the hand, middle row, ulnar edge", "mid hand 1", "hand"),
    16: ("Back of the hand, middle row, ulnar", "mid hand 2", "hand"),
    25: ("Back of the hand, middle row, just ulnar of the middle", "mid hand 3", "hand"),
    34: ("Back of the hand, middle row, just radial of the middle", "mid hand 4", "hand"),
    38: ("Back of the hand, middle row, radial", "mid hand 5", "hand"),
    40: ("Back of the hand, base of the thumb", "thumb base", "hand"),
    9: ("Back of the hand at the wrist, ulnar edge", "hand end 1", "hand"),
    18: ("Back of the hand at the wrist, ulnar", "hand end 2", "hand"),
    27: ("Back of the hand at the wrist, middle", "hand end 3", "hand"),
    36: ("Back of the hand at the wrist, radial", "hand end 4", "hand"),
    39: ("Back of the hand at the wrist, radial edge", "hand end 5", "hand"),
    43: ("Wrist, first row, ulnar edge", "wrist 1 uln. edge", "wrist"),
    44: ("Wrist, first row, ulnar", "wrist 1 uln.", "wrist"),
    52: ("Wrist, first row, radial", "wrist 1 rad.", "wrist"),
    53: ("Wrist, first row, radial edge", "wrist 1 rad. edge", "wrist"),
    45: ("Wrist, second row, ulnar edge", "wrist 2 uln. edge", "wrist"),
    46: ("Wrist, second row, ulnar", "wrist 2 uln.", "wrist"),
    54: ("Wrist, second row, radial", "wrist 2 rad.", "wrist"),
    55: ("Wrist, second row, radial edge", "wrist 2 rad. edge", "wrist"),
    61: ("Wrist, palm side, first row, middle", "palm wrist 1 mid", "wrist"),
    62: ("Wrist, palm side, first row, ulnar", "palm wrist 1 uln.", "wrist"),
    63: ("Wrist, palm side, second row, middle", "palm wrist 2 mid", "wrist"),
    64: ("Wrist, palm side, second row, ulnar", "palm wrist 2 uln.", "wrist"),
    66: ("Forearm, palm side, ulnar, towards the wrist", "palm arm 1", "forearm"),
    65: ("Forearm, palm side, ulnar, towards the elbow", "palm arm 2", "forearm"),
    69: ("Elbow, middle", "elbow mid", "elbow"),
    68: ("Elbow, radial", "elbow rad.", "elbow"),
    67: ("Elbow, radial edge", "elbow rad. edge", "elbow"),
    70: ("Elbow, ulnar", "elbow uln.", "elbow"),
    72: ("Elbow, ulnar edge, nearer the hand", "elbow uln. edge 1", "elbow"),
    71: ("Elbow, ulnar edge, farther from the hand", "elbow uln. edge 2", "elbow"),
}
# From wrist to elbow.
_FOREARM_ROWS = {
    ("ulnar side", "uln."): (48, 47, 50, 49, 51),
    ("middle", "mid"): (57, 56, 59, 58, 60),
}


def _output_places() -> tuple[OutputPlace, ...]:
    rows = dict(_OTHER_OUTPUTS)
    for digit, numbers in _DIGIT_OUTPUTS.items():
        for number, (name, short_name, on_digit) in zip(numbers, _ON_DIGIT, strict=True):
            region = f"digit {digit}" if on_digit else "hand"
            rows[number] = (f"Digit {digit}, {name}", f"{digit} {short_name}", region)
    for (name, short_name), row_numbers in _FOREARM_ROWS.items():
        for row, number in enumerate(row_numbers, start=1):
            rows[number] = (
                f"Forearm, {name}, {row} of {len(row_numbers)} from the wrist",
                f"arm {short_name} {row}",
                "forearm",
            )
    return tuple(
        OutputPlace(
            number=number,
            name=name,
            short_name=short_name,
            side="volar" if 61 <= number <= 66 else "dorsal",
            region=region,
        )
        for number, (name, short_name, region) in sorted(rows.items())
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class LocationNames:
    """What a place is called, whether or not it is one of those named here.

    Attributes
    ----------
    number
        From 1.
    name, short_name
        As of `InputPlace` and `OutputPlace`.
    kind
        Contact of an input place, side of an output place; empty where that is not known.
    """

    number: int
    name: str
    short_name: str
    kind: str


INPUTS: tuple[InputPlace, ...] = _input_places()
OUTPUTS: tuple[OutputPlace, ...] = _output_places()


def input_place(number: int) -> InputPlace:
    """Return the input place ``number``, 1 to 20.

    Raises
    ------
    InvalidInputError
        There is no such place.
    """
    check_input_location(number)
    return INPUTS[number - 1]


def output_place(number: int) -> OutputPlace:
    """Return the output place ``number``, 1 to 72.

    Raises
    ------
    InvalidInputError
        There is no such place.
    """
    is_integer = isinstance(number, int | np.integer) and not isinstance(number, bool)
    if not is_integer or not 1 <= number <= N_OUTPUTS:
        raise InvalidInputError(
            f"output location {quoted(number)} does not exist: locations are the whole numbers "
            f"1 to {N_OUTPUTS}. See skinsource.limbs.locations for the list."
        )
    return OUTPUTS[number - 1]


def input_name(number: int, limb: str = "") -> LocationNames:
    """Return the names of input place ``number`` of a limb, whether or not it is known here.

    Of a limb that is missing nobody knows more of a place than its number.

    >>> input_name(25).name
    'Place 25, not on this hand'
    """
    facts = facts_of(limb)
    if (facts.own and 1 <= number <= facts.n_inputs) or facts.missing:
        return _own_names(number, facts.input_names, "Place", "place")
    if facts.own or not 1 <= number <= len(INPUTS):
        return LocationNames(
            number=number,
            name=f"Place {number}, not on this hand",
            short_name="not on this hand",
            kind="",
        )
    place = INPUTS[number - 1]
    return LocationNames(
        number=number, name=place.name, short_name=place.short_name, kind=place.contact
    )


def output_name(number: int, limb: str = "") -> LocationNames:
    """Return the names of output place ``number`` of a limb, whether or not it is known here.

    >>> output_name(80).name
    'Not on this limb'
    """
    facts = facts_of(limb)
    if (facts.own and 1 <= number <= facts.n_outputs) or facts.missing:
        return _own_names(number, facts.output_names, "Output", "output")
    if facts.own or not 1 <= number <= len(OUTPUTS):
        return LocationNames(
            number=number, name="Not on this limb", short_name="not on this limb", kind=""
        )
    place = OUTPUTS[number - 1]
    return LocationNames(
        number=number, name=place.name, short_name=place.short_name, kind=place.side
    )


def _own_names(number: int, names: tuple[str, ...], long: str, short: str) -> LocationNames:
    """Return the names of a place of an imported limb; its number where the lab gave none."""
    name = names[number - 1] if names else ""
    return LocationNames(
        number=number,
        name=name or f"{long} {number}",
        short_name=name or f"{short} {number}",
        kind="",
    )
