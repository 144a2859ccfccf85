"""Drives as samples: the least of a quadratic cost, freely or within a peak, and their design."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from skinsource.base.conventions import Complexes, Floats
from skinsource.base.errors import TooInaccurateError
from skinsource.design.design import Design, track
from skinsource.design.waveforms.samples import Recording
from skinsource.inverse.responses import inverse_of
from skinsource.limbs.limb import LimbFacts
from skinsource.specs.samples import Samples

# Residual at which the exact solution is reached, and most steps to it.
_RESIDUAL, _MOST_STEPS = 1e-9, 3000
# Last move within a peak, in parts of it.
_SETTLED = 1e-6


@dataclass(frozen=True, kw_only=True, eq=False)
class Cost:
    """x* N x - 2 Re(b* x) of drives x that begin at sample 0 and last ``n_times`` samples.

    Attributes
    ----------
    normal : (n_fft // 2 + 1, n_used, n_used)
        N at each bin: what is to be little, of the responses and of the drives themselves.
    n_fft
        Length of the transforms: drives and responses fit in without wrapping round.
    n_times
        Length of the drives.
    """

    normal: Complexes
    n_fft: int
    n_times: int

    def applied(self, drives: Floats) -> Floats:
        """Return N x within the drives' time, (n_used, n_times)."""
        return self._through(self.normal, drives)

    def cut(self, spectra: Complexes) -> Floats:
        """Return the drives with these spectra, (n_bins, n_used), cut to their time."""
        return scipy.fft.irfft(spectra, self.n_fft, axis=0)[: self.n_times].T

    def fast(self, wanted: Complexes) -> Floats:
        """Return the least bin by bin, cut, (n_used, n_times), for b, (n_bins, n_used)."""
        return self.cut((inverse_of(self.normal) @ wanted[..., None])[..., 0])

    def exact(self, wanted: Complexes) -> Floats:
        """Return the least of drives of this length, by conjugate gradients.

        Raises
        ------
        TooInaccurateError
            It is not reached.
        """
        drives, steps = scipy.sparse.linalg.cg(
            self._operator(self.normal),
            self.cut(wanted).ravel(),
            self.fast(wanted).ravel(),
            M=self._operator(inverse_of(self.normal)),
            rtol=_RESIDUAL,
            maxiter=_MOST_STEPS,
        )
        if steps:
            raise TooInaccurateError(
                "The drives do not settle. Raise beta, or take the fast solution (exact=False)."
            )
        return np.asarray(drives.reshape(-1, self.n_times), np.float64)

    def within(self, peak: float, b: Floats, start: Floats) -> Floats:
        """Return the least of drives of at most ``peak``, for b in time, (n_used, n_times).

        Accelerated gradient descent, each step brought back within the peak (FISTA).
        """
        step = 1.0 / np.linalg.norm(self.normal, ord=2, axis=(1, 2)).max()
        drives = ahead = np.clip(start, -peak, peak)
        pace = 1.0
        for _ in range(_MOST_STEPS):
            previous, last_pace = drives, pace
            drives = np.clip(ahead - step * (self.applied(ahead) - b), -peak, peak)
            moved = drives - previous
            if np.abs(moved).max() <= _SETTLED * peak:
                break
            # Momentum that leads uphill begins anew.
            uphill = np.vdot(ahead - drives, moved) > 0.0
            pace = 1.0 if uphill else 0.5 * (1.0 + np.sqrt(1.0 + 4.0 * last_pace**2))
            ahead = drives if uphill else drives + (last_pace - 1.0) / pace * moved
        return drives

    def _operator(self, matrices: Complexes) -> scipy.sparse.linalg.LinearOperator:
        size = self.normal.shape[-1] * self.n_times

        def applied(drives: Floats) -> Floats:
            return self._through(matrices, drives.reshape(-1, self.n_times)).ravel()

        return scipy.sparse.linalg.LinearOperator((size, size), matvec=applied, dtype=np.float64)

    def _through(self, matrices: Complexes, drives: Floats) -> Floats:
        spectra = scipy.fft.rfft(drives, self.n_fft).T
        return self.cut((matrices @ spectra[..., None])[..., 0])


def samples_of(limb: LimbFacts, drive: Floats) -> Samples:
    """Return a drive, (n_times,), as samples with their unit."""
    unit = "" if limb.per_unit_drive else "m/s²"
    return Samples(values=drive, sample_rate_hz=limb.sample_rate_hz, unit=unit)


def played(limb: LimbFacts, inputs: Sequence[int], drives: Floats, name: str) -> Design:
    """Return a design with a track for each drive, (n_inputs, n_times), that is not silent.

    Drives are probe acceleration, m/s²; those of own limbs in the unit of their drive.
    """
    tracks = [
        track(place, Recording(samples=samples_of(limb, drive), name=name))
        for place, drive in zip(inputs, drives, strict=True)
        if drive.any()
    ]
    return Design(limb=limb.name, limb_digest=limb.digest, inputs=tuple(tracks), title=name)
