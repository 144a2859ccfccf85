"""Spectra of a limb's responses at the frequencies of an inverse design."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import ArrayLike

from skinsource.actuators.equalising import followed_band
from skinsource.base.arguments import finite_array, integer
from skinsource.base.conventions import Axes, Band, Complexes, Floats, axis_numbers
from skinsource.base.errors import InvalidInputError
from skinsource.engine.analysis_rules import place_noise
from skinsource.limbs.limb import PUBLISHED, Limb, LimbFacts
from skinsource.limbs.own_limbs import facts_of
from skinsource.signals.analysis.noise import LEAST_ABOVE_NOISE_DB

#: Outputs on the hand of the published limbs, from 1: what is quiet unless somebody says else.
HAND_OUTPUTS = tuple(range(1, 43))
#: Inputs of the published limbs that push into the skin.
PERPENDICULAR_INPUTS = tuple(range(6, 21))
#: Above it responses of the published limbs are mostly noise.
HIGHEST_HZ = 400.0


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Responses:
    """Spectra of responses.

    Attributes
    ----------
    limb
        Whose.
    inputs
        Places in use, from 1.
    frequencies_hz : (n_bins,)
        Of the bins.
    values : (n_bins, n_outputs, n_axes, n_used)
        m/s² for each unit of the drive.
    noise_energy : (n_outputs,) or None
        Mean of |noise|² in a bin, summed over the axes, (m/s²)²; None: it is not known.
    """

    limb: LimbFacts
    inputs: tuple[int, ...]
    frequencies_hz: Floats
    values: Complexes
    noise_energy: Floats | None

    def rows(self, outputs: Sequence[int]) -> Complexes:
        """Return the rows of some outputs, (n_bins, n_outputs · n_axes, n_used)."""
        chosen = self.values[:, np.asarray(outputs, dtype=int) - 1]
        return chosen.reshape(len(chosen), -1, chosen.shape[-1])

    @cached_property
    def above_noise_db(self) -> Floats:
        """Level of each output's responses above their noise, (n_outputs,); may be infinite."""
        energy = np.mean(np.square(np.abs(self.values)).sum(axis=2), axis=(0, 2))
        noise = np.zeros_like(energy) if self.noise_energy is None else self.noise_energy
        return np.where(energy > 0.0, power_db(energy, noise), -np.inf)

    @cached_property
    def others(self) -> tuple[int, ...]:
        """Outputs that are quiet unless somebody says else."""
        if self.limb.name in PUBLISHED:
            return HAND_OUTPUTS
        heard = self.above_noise_db >= LEAST_ABOVE_NOISE_DB
        return tuple(int(k) + 1 for k in np.flatnonzero(heard))

    def check_target(self, output: int) -> int:
        """Return an output that can be a target.

        Raises
        ------
        InvalidInputError
            There is no such output, or its responses are mostly noise.
        """
        output = self.check_output(output)
        above_db = float(self.above_noise_db[output - 1])
        if above_db == -np.inf:
            raise InvalidInputError(
                f"output {output} of {self.limb.name} does not respond to the inputs in use. "
                "Choose another output, or other inputs."
            )
        if above_db < LEAST_ABOVE_NOISE_DB:
            raise InvalidInputError(
                f"output {output} of {self.limb.name} is {above_db:.1f} dB above its noise, "
                f"expected at least {LEAST_ABOVE_NOISE_DB:g} dB. Choose another output, or lower "
                "frequencies."
            )
        return output

    def check_output(self, output: int) -> int:
        """Return the number of an output; raise `InvalidInputError` where there is none."""
        return integer("output", output, 1, self.limb.n_outputs)


def bins_of(n_fft: int, sample_rate_hz: float) -> Floats:
    """Return the frequencies of the bins of a transform, (n_fft // 2 + 1,)."""
    return np.arange(n_fft // 2 + 1, dtype=np.float64) * (sample_rate_hz / n_fft)


def n_fft_of(n_taps: int) -> int:
    """Return the length of transforms for responses of ``n_taps``: 1024 for 522."""
    return int(2 ** np.ceil(np.log2(1.9 * n_taps)))


def responses_of(
    limb: Limb,
    *,
    axes: Axes = "z",
    inputs: Sequence[int] | None = None,
    frequencies_hz: ArrayLike | None = None,
) -> Responses:
    """Return the spectra of a limb's responses; those asked last are remembered.

    Parameters
    ----------
    limb
        Whose.
    axes
        Along which.
    inputs
        Places, from 1; None: the perpendicular ones of published limbs, all of own limbs.
    frequencies_hz : (n_bins,), optional
        None: every bin of the transform from 25 to 400 Hz, of own limbs within their band.

    Raises
    ------
    InvalidInputError
        There is no such place, or a frequency is not within the band.
    """
    published = limb.name in PUBLISHED
    band = followed_band(limb.band_hz, limb.sample_rate_hz)
    if inputs is None:
        inputs = PERPENDICULAR_INPUTS if published else range(1, limb.n_inputs + 1)
    used = tuple(inputs)
    for place in used:
        limb.check_place(place)
    if not used or len(set(used)) < len(used):
        raise InvalidInputError(f"inputs are {list(used)}, expected one place or more, each once")
    if frequencies_hz is None:
        top_hz = min(band[1], HIGHEST_HZ) if published else band[1]
        all_hz = bins_of(n_fft_of(limb.n_taps), limb.sample_rate_hz)
        at_hz = all_hz[(all_hz >= band[0]) & (all_hz <= top_hz)]
    else:
        at_hz = _checked_frequencies(frequencies_hz, band)
    known = _RESPONSES.setdefault(limb, {})
    key = (axis_numbers(axes, limb.axes), used, at_hz.tobytes())
    if key not in known:
        if len(known) >= _MOST:
            known.pop(next(iter(known)))
        known[key] = spectra_of(limb, axes, used, at_hz)
    return known[key]


_MOST = 8
_Key = tuple[tuple[int, ...], tuple[int, ...], bytes]
_RESPONSES: WeakKeyDictionary[Limb, dict[_Key, Responses]] = WeakKeyDictionary()


def _checked_frequencies(frequencies_hz: ArrayLike, band: Band) -> Floats:
    at_hz = np.atleast_1d(finite_array("frequencies_hz", frequencies_hz, "frequencies in Hz"))
    if at_hz.ndim != 1 or not at_hz.size or (np.diff(at_hz) <= 0.0).any():
        raise InvalidInputError(
            "frequencies_hz does not rise, expected (n_bins,). Sort the frequencies."
        )
    if at_hz[0] < band[0] or at_hz[-1] > band[1]:
        raise InvalidInputError(
            f"frequencies_hz reach from {at_hz[0]:g} to {at_hz[-1]:g} Hz, but responses were "
            f"measured from {band[0]:g} to {band[1]:g} Hz. Choose frequencies within."
        )
    return at_hz


def spectra_of(limb: Limb, axes: Axes, inputs: tuple[int, ...], at_hz: Floats) -> Responses:
    """Return the spectra of responses at any frequencies; they are not remembered."""
    numbers = axis_numbers(axes, limb.axes)
    taps = np.stack([limb.response_to(place)[:, numbers] for place in inputs])
    phase = 2.0 * np.pi / limb.sample_rate_hz * np.arange(limb.n_taps)[:, None] * at_hz
    rows = taps.reshape(-1, limb.n_taps)
    # Two real products take half the time of a complex one.
    values = (rows @ np.cos(phase) - 1j * (rows @ np.sin(phase))).reshape(*taps.shape[:3], -1)
    noises = [place_noise(limb, place) for place in inputs]
    known = [noise[:, numbers] for noise in noises if noise is not None]
    names = (each.name for each in fields(LimbFacts) if hasattr(limb, each.name))
    return Responses(
        limb=replace(facts_of(limb.name), **{name: getattr(limb, name) for name in names}),
        inputs=inputs,
        frequencies_hz=at_hz,
        values=np.ascontiguousarray(np.moveaxis(values, (3, 0), (0, 3))),
        noise_energy=limb.n_taps * np.square(known).sum(axis=2).mean(axis=0) if known else None,
    )


def loading(gram: Complexes) -> Floats:
    """Return λ at β = 1: tr(R) / n, (n_bins,); 1 where R is 0."""
    mean = np.trace(gram, axis1=1, axis2=2).real / gram.shape[-1]
    return np.where(mean > 0.0, mean, 1.0)


def gram_of(rows: Complexes) -> Complexes:
    """Return the sum of conj(G) G over rows, (n_bins, n_used, n_used), of (n_bins, n, n_used)."""
    return rows.conj().swapaxes(1, 2) @ rows


def power_db(energy: Floats, reference: Floats | float = 1.0) -> Floats:
    """Return 10 log10(energy / reference); NaN where both are 0."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return 10.0 * (np.log10(energy) - np.log10(reference))


def inverse_of(matrices: Complexes) -> Complexes:
    """Return the inverses of matrices, (..., n, n)."""
    return np.linalg.inv(matrices).astype(np.complex128, copy=False)
