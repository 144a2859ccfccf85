"""One upper limb: its impulse responses and its map."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError
from skinsource.quoting import quoted
from skinsource.work import tally

N_INPUTS, N_OUTPUTS, N_AXES, N_TAPS = 20, 72, 3, 522
SAMPLE_RATE_HZ = 1300.0
#: Time between the trigger and the pulse in the measured responses.
PRE_TRIGGER_DELAY_S = 0.052
#: Outputs on the palmar side: they have no place on the dorsal map.
VOLAR_OUTPUTS = (61, 62, 63, 64, 65, 66)

#: The largest number that a place or an output of any limb can have.
MOST_PLACES = 10_000

#: Hand lengths of limbs 1 to 4, measured and synthetic alike.
HAND_LENGTHS_MM = (175.0, 165.0, 185.0, 165.0)
#: Every limb that exists, installed or not.
LIMB_NAMES = tuple(f"{kind}-{k}" for kind in ("measured", "synthetic") for k in range(1, 5))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LimbMap:
    """Where things are on the back of a right hand and arm.

    Coordinates are outline pixels: x to the right, y up (towards the fingertips), thumb to the
    left.  ``hand_length_px`` of them make one hand length.

    Attributes
    ----------
    outline : (n_vertices, 2)
        Closed polygon, last vertex not repeated.
    output_positions : (72, 2)
        Sensors; rows of the six volar outputs (61 to 66) are NaN.
    input_positions : (20, 2)
        Input places, seen through the hand from the back.
    hand_length_px
        Tip of digit III to the middle of the wrist, in pixels.
    visibility : (n_vertices, 72) or None
        Distance from outline vertex to output where the one sees the other, else NaN.
        ``None``: the surface operator applies its own rule.
    densify
        Whether the surface operator may split long outline edges (own outlines yes; the
        published outline no, for parity).
    """

    outline: Floats
    output_positions: Floats
    input_positions: Floats
    hand_length_px: float
    visibility: Floats | None = None
    densify: bool = True


class Limb:
    """An upper limb whose responses are read when touched, one input place at a time.

    Attributes
    ----------
    name
        ``"measured-1"`` to ``"measured-4"``, ``"synthetic-1"`` to ``"synthetic-4"``.
    sample_rate_hz, hand_length_mm
        1300.0; length of the hand.
    n_inputs, n_outputs, n_axes, n_taps
        Input places, outputs, axes and samples of a response: 20, 72, 3 and 522 for the limbs that
        were measured and those like them.
    synthetic
        Whether the responses are computed, not measured.  Every view and export says so.
    map
        Places on the dorsal map, a `LimbMap`.
    note
        What the user should know of the data, such as that they are not the published ones; shown
        with the limb's name by every view and export.  Empty where there is nothing to say.
    bytes_read
        How many bytes of responses were read or computed so far.
    """

    def __init__(
        self,
        *,
        name: str,
        hand_length_mm: float,
        synthetic: bool,
        map: LimbMap,
        read_response: Callable[[int], Floats],
        sample_rate_hz: float = SAMPLE_RATE_HZ,
        note: str = "",
        shape: tuple[int, int, int, int] = (N_INPUTS, N_OUTPUTS, N_AXES, N_TAPS),
    ) -> None:
        self.name = name
        self.hand_length_mm = hand_length_mm
        self.synthetic = synthetic
        self.map = map
        self.sample_rate_hz = sample_rate_hz
        self.note = note
        self.n_inputs, self.n_outputs, self.n_axes, self.n_taps = shape
        self.bytes_read = 0
        self._read_response = read_response
        self._responses: dict[int, Floats] = {}
        self._largest: dict[int, float] = {}
        self._everything: Floats | None = None

    def __repr__(self) -> str:
        kind = "synthetic" if self.synthetic else "measured"
        return f"<Limb {self.name}: {kind}, hand {self.hand_length_mm:g} mm>"

    def response_to(self, location: int) -> Floats:
        """Impulse responses to one input place, (n_outputs, n_axes, n_taps), in m/s²."""
        check_input_location(location, self.n_inputs)
        if location not in self._responses:
            response = self._read_response(location)
            expected = self.n_outputs, self.n_axes, self.n_taps
            if response.shape != expected:
                raise InvalidInputError(
                    f"{self.name}: the response to input location {location} has shape "
                    f"{response.shape}, expected {expected} (outputs, axes, taps). Install or load "
                    "the limb again."
                )
            response.flags.writeable = False
            self.bytes_read += response.nbytes
            tally(bytes_read=response.nbytes)
            self._responses[location] = response
        return self._responses[location]

    def largest_response_to(self, location: int) -> float:
        """Largest magnitude of a response to one input place, m/s²; NaN where one is no number."""
        if location not in self._largest:
            response = self.response_to(location)
            # Twice through it, but without a copy of it all.
            highest, lowest = float(response.max(initial=0.0)), float(response.min(initial=0.0))
            self._largest[location] = math.nan if math.isnan(highest) else max(highest, -lowest)
        return self._largest[location]

    @property
    def impulse_responses(self) -> Floats:
        """All impulse responses, (n_inputs, n_outputs, n_axes, n_taps), in m/s²."""
        if self._everything is None:
            places = range(1, self.n_inputs + 1)
            everything = np.stack([self.response_to(place) for place in places])
            everything.flags.writeable = False
            # The single responses are views of it from now on: nothing is held twice.
            self._responses = {place: everything[place - 1] for place in places}
            self._everything = everything
        return self._everything


def check_input_location(location: int, n_inputs: int = N_INPUTS) -> None:
    """Raise `InvalidInputError` unless ``location`` is an integer from 1 to ``n_inputs``."""
    is_integer = isinstance(location, int | np.integer) and not isinstance(location, bool)
    if not is_integer or not 1 <= location <= n_inputs:
        raise InvalidInputError(
            f"input location {quoted(location)} does not exist: locations are the whole numbers 1 "
            f"to {n_inputs}. See skinsource.locations for the list."
        )
