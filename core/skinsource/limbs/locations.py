"""The 20 input places and the 72 output places of the published limbs: names, sides and regions.

Limbs that a lab imported have places of their own, which `input_name` and `output_name` know.
"""

import json
from dataclasses import dataclass
from typing import Literal

from skinsource.base.arguments import checking
from skinsource.base.assets import data_folder
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


@dataclass(frozen=True, slots=True)
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


_PLACES = json.loads((data_folder() / "places.json").read_text(encoding="utf-8"))
INPUTS: tuple[InputPlace, ...] = tuple(InputPlace(**place) for place in _PLACES["inputs"])
OUTPUTS: tuple[OutputPlace, ...] = tuple(OutputPlace(**place) for place in _PLACES["outputs"])


@checking
def input_name(number: int, limb: str = "") -> LocationNames:
    """Return the names of input place ``number`` of a limb, whether or not it is known here.

    For a missing limb only the number of a place is known.

    >>> input_name(25).name
    'Place 25, not on this hand'
    """
    facts = facts_of(limb)
    if (facts.own and 1 <= number <= facts.n_inputs) or facts.missing:
        return _own_names(number, facts.input_names, "Place", "place")
    if facts.own or not 1 <= number <= len(INPUTS):
        return LocationNames(number, f"Place {number}, not on this hand", "not on this hand", "")
    place = INPUTS[number - 1]
    return LocationNames(number, place.name, place.short_name, place.contact)


@checking
def output_name(number: int, limb: str = "") -> LocationNames:
    """Return the names of output place ``number`` of a limb, whether or not it is known here.

    >>> output_name(80).name
    'Not on this limb'
    """
    facts = facts_of(limb)
    if (facts.own and 1 <= number <= facts.n_outputs) or facts.missing:
        return _own_names(number, facts.output_names, "Output", "output")
    if facts.own or not 1 <= number <= len(OUTPUTS):
        return LocationNames(number, "Not on this limb", "not on this limb", "")
    place = OUTPUTS[number - 1]
    return LocationNames(number, place.name, place.short_name, place.side)


def _own_names(number: int, names: tuple[str, ...], long: str, short: str) -> LocationNames:
    """Return the names of a place of an imported limb; its number where the lab gave none."""
    name = names[number - 1] if names else ""
    return LocationNames(number, name or f"{long} {number}", name or f"{short} {number}", "")


__all__ = [
    "INPUTS",
    "OUTPUTS",
    "REGIONS",
    "InputPlace",
    "LocationNames",
    "OutputPlace",
    "input_name",
    "output_name",
]
