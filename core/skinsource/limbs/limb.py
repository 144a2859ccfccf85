"""An upper limb: its impulse responses, its map, and the facts known before responses are read."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from inspect import signature
from typing import Any

import numpy as np

from skinsource.base.conventions import (
    AXES,
    BAND_HZ,
    HAND_LENGTHS_MM,
    LIMB_NAMES,
    N_AXES,
    N_INPUTS,
    N_OUTPUTS,
    N_TAPS,
    PRE_TRIGGER_DELAY_S,
    SAMPLE_RATE_HZ,
    Axes,
    Band,
    Floats,
    check_input_location,
)
from skinsource.base.errors import InvalidInputError, quoted
from skinsource.base.work import tally


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class LimbMap:
    """Where things are on the back of a right hand and arm.

    Coordinates are outline pixels: x to the right, y up (towards the fingertips), thumb to the
    left.  ``hand_length_px`` of them make one hand length.

    Attributes
    ----------
    outline : (n_vertices, 2)
        Closed polygon, last vertex not repeated.
    output_positions : (n_outputs, 2)
        Sensors; rows of those that have no place here are NaN: 61 to 66, on the palmar side, of
        the published limbs.
    input_positions : (n_inputs, 2)
        Input places, seen through the hand from the back.
    hand_length_px
        Tip of digit III to the middle of the wrist, in pixels.
    visibility : (n_vertices, n_outputs) or None
        Distance from outline vertex to output where the one sees the other, else NaN.
        ``None``: the surface operator applies its own rule.
    densify
        Whether the surface operator may split long outline edges (own outlines yes; the
        published outline no, for parity).
    axes_shown
        Whether the sensors' axes point as those of the published limbs do, which the map shows.
    """

    outline: Floats
    output_positions: Floats
    input_positions: Floats
    hand_length_px: float
    visibility: Floats | None = None
    densify: bool = True
    axes_shown: bool = True

    def __repr__(self) -> str:
        return (
            f"<LimbMap: {len(self.output_positions)} outputs, {len(self.input_positions)} inputs, "
            f"outline of {len(self.outline)} points>"
        )

    @property
    def unplaced(self) -> tuple[int, ...]:
        """Numbers of the outputs that have no place here."""
        return tuple(int(k) + 1 for k in np.flatnonzero(np.isnan(self.output_positions[:, 0])))


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
    axes
        Along which each output measures, in this order: ``"xyz"``; ``"xz"`` for two of them.
    pre_trigger_delay_s
        Delay of the responses: 0.052 in the published limbs.
    band_hz
        In which the responses were measured, 25 to 600 Hz of the published limbs; None: unknown; no
        frequency causes a warning, and all count.
    per_unit_drive
        Whether responses are to one sample of the drive, so that convolution suffices; else they
        are to the measuring pulse of the published limbs, by which probe scaling divides.
    synthetic
        Whether the responses are computed, not measured.  Every view and export says so.
    map
        Places on the dorsal map, a `LimbMap`.
    note
        Note for users, such as that the data are not the published ones; shown with the limb's name
        by every view and export.  Empty where there is nothing to say.
    lead_samples
        Samples of a response that lie before time 0: none, unless an actuator stands before it.
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
        axes: Axes = "xyz",
        pre_trigger_delay_s: float = PRE_TRIGGER_DELAY_S,
        band_hz: Band | None = BAND_HZ,
        per_unit_drive: bool = False,
        note: str = "",
        shape: tuple[int, int, int, int] = (N_INPUTS, N_OUTPUTS, N_AXES, N_TAPS),
        lead_samples: int = 0,
    ) -> None:
        self.name = name
        self.hand_length_mm = hand_length_mm
        self.synthetic = synthetic
        self.map = map
        self.sample_rate_hz = sample_rate_hz
        self.note = note
        self.n_inputs, self.n_outputs, self.n_axes, self.n_taps = shape
        if axes not in AXES or len(axes) != self.n_axes:
            raise InvalidInputError(
                f"{name}: axes is {quoted(axes)}, expected {self.n_axes} of x, y and z, in their "
                "order, as many as the responses have"
            )
        self.axes: Axes = axes
        self.pre_trigger_delay_s = pre_trigger_delay_s
        self.band_hz = band_hz
        self.per_unit_drive = per_unit_drive
        self.lead_samples = lead_samples
        self.bytes_read = 0
        self._read_response = read_response
        self._responses: dict[int, Floats] = {}
        self._largest: dict[int, float] = {}
        self._everything: Floats | None = None

    def __repr__(self) -> str:
        kind = "synthetic" if self.synthetic else "measured"
        return f"<Limb {self.name}: {kind}, hand {self.hand_length_mm:g} mm>"

    def check_place(self, location: int) -> None:
        """Raise an `InvalidInputError` where there is no such input place."""
        try:
            check_input_location(location, self.n_inputs)
        except InvalidInputError as error:
            raise InvalidInputError(
                f"{self.name} has the places 1 to {self.n_inputs}, and there is an input at place "
                f"{quoted(location)}. Move the input, or choose another limb."
            ) from error

    def response_to(self, location: int) -> Floats:
        """Return the impulse responses to one input place, (n_outputs, n_axes, n_taps), in m/s²."""
        self.check_place(location)
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
        """Return the largest magnitude of the responses to a place, m/s²; NaN if one holds NaN."""
        if location not in self._largest:
            response = self.response_to(location)
            # Two passes through the array need no copy of it.
            highest, lowest = float(response.max(initial=0.0)), float(response.min(initial=0.0))
            self._largest[location] = math.nan if math.isnan(highest) else max(highest, -lowest)
        return self._largest[location]

    @property
    def output_positions_mm(self) -> Floats:
        """Places of the outputs, (n_outputs, 2), mm: x away from the thumb, y to the fingertips."""
        return self.map.output_positions * (self.hand_length_mm / self.map.hand_length_px)

    @property
    def input_positions_mm(self) -> Floats:
        """Places of the inputs, (n_inputs, 2), as `output_positions_mm`."""
        return self.map.input_positions * (self.hand_length_mm / self.map.hand_length_px)

    @property
    def impulse_responses(self) -> Floats:
        """All impulse responses, (n_inputs, n_outputs, n_axes, n_taps), in m/s²."""
        if self._everything is None:
            places = range(1, self.n_inputs + 1)
            everything = np.stack([self.response_to(place) for place in places])
            everything.flags.writeable = False
            # From now on the single responses are views of it: nothing is in memory twice.
            self._responses = {place: everything[place - 1] for place in places}
            self._everything = everything
        return self._everything


#: Places and outputs of a limb whose results can follow each edit; of larger ones they are
#: computed as jobs: exports, sweeps and scripts.
LIVE_INPUTS, LIVE_OUTPUTS = 64, 128


def limb_like(about: Any, **others: Any) -> Limb:
    """Return a limb of the names and conditions of another one, but for those in ``others``."""
    names = [name for name in signature(Limb).parameters if hasattr(about, name)]
    return Limb(**({name: getattr(about, name) for name in names} | others))


@dataclass(frozen=True, slots=True, kw_only=True)
class LimbFacts:
    """Names and sizes of a limb.

    Attributes
    ----------
    name, title, sentence
        As files name it; as the window does; and what it is.
    n_inputs, n_outputs, n_taps, axes, sample_rate_hz, pre_trigger_delay_s, band_hz, hand_length_mm
        As of `Limb`.
    per_unit_drive
        As of `Limb`; the unit of that drive is not known.
    synthetic
        Whether it is computed, not measured.
    own
        Whether a lab imported it: its places are its own.
    known
        Whether there is such a limb here; if not, its sizes are those of the published ones.
    input_names, output_names
        Of an own limb, one for each; empty ones have no name.
    digest
        SHA-256 of all numbers of an own limb; empty for others, which their name stands for.
    left, mirrored
        Whether it is a left hand, and whether it is shown as a right one.
    """

    name: str
    title: str
    sentence: str
    n_inputs: int = N_INPUTS
    n_outputs: int = N_OUTPUTS
    n_taps: int = N_TAPS
    axes: Axes = "xyz"
    sample_rate_hz: float = SAMPLE_RATE_HZ
    pre_trigger_delay_s: float = PRE_TRIGGER_DELAY_S
    band_hz: Band | None = BAND_HZ
    hand_length_mm: float = 0.0
    per_unit_drive: bool = False
    synthetic: bool = False
    own: bool = False
    known: bool = True
    input_names: tuple[str, ...] = ()
    output_names: tuple[str, ...] = ()
    digest: str = ""
    left: bool = False
    mirrored: bool = False

    @property
    def missing(self) -> bool:
        """Whether a name is known and nothing else: not even in which band it was measured."""
        return bool(self.name) and not self.known

    @property
    def live(self) -> bool:
        """Whether it is small enough for results that follow each edit."""
        return self.n_inputs <= LIVE_INPUTS and self.n_outputs <= LIVE_OUTPUTS


_SENTENCES = {
    "measured": "Impulse responses measured on one person's hand and arm.",
    "synthetic": "Impulse responses computed from a model of waves in the skin, not measured.",
}


def _published(name: str) -> LimbFacts:
    kind, _, number = name.partition("-")
    length_mm = HAND_LENGTHS_MM[int(number) - 1]
    return LimbFacts(
        name=name,
        title=f"{kind.capitalize()} {number} ({length_mm:g} mm)",
        sentence=_SENTENCES[kind],
        hand_length_mm=length_mm,
        synthetic=kind == "synthetic",
    )


#: Of the published limbs and of the synthetic ones, by name.
PUBLISHED = {name: _published(name) for name in LIMB_NAMES}
