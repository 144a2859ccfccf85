"""What actuators get, in numbers."""

from dataclasses import dataclass

import numpy as np

from skinsource.arrays import Floats
from skinsource.chain import Drive
from skinsource.limb import Band
from skinsource.rendering.placed import Placed
from skinsource.spectra import share_outside_band
from skinsource.sweeps.prepared import Prepared


@dataclass(frozen=True, slots=True, eq=False)
class _Known:
    """Of a drive: its largest sample, its energy, and the share of that outside the band."""

    drive: Drive
    peak: float
    energy: float
    outside: float


class DriveMetrics:
    """Measures drives; those of inputs that stay as they are once."""

    def __init__(self) -> None:
        self._known: dict[int, _Known] = {}

    def of(self, one: Prepared, factor: float) -> dict[str, float]:
        """Peak and RMS of all channels, and the share of energy outside the band.

        Parameters
        ----------
        factor
            What all amplitudes are multiplied with.
        """
        rate_hz, n_times = one.limb.sample_rate_hz, one.stimulus_samples
        channels: dict[int, list[tuple[float, Placed, _Known]]] = {}
        energy = outside = 0.0
        for each in one.placed:
            weight = each.voice.amplitude * each.drive.factor * factor
            known = self._of_drive(each, rate_hz, one.limb.band_hz)
            channels.setdefault(each.voice.location, []).append((weight, each, known))
            energy += weight**2 * known.energy
            outside += weight**2 * known.energy * known.outside
        peak = squares = 0.0
        for inputs in channels.values():
            if len(inputs) == 1:
                weight, _, known = inputs[0]
                peak = max(peak, abs(weight) * known.peak)
                squares += weight**2 * known.energy
            else:
                total = _sum(inputs, n_times)
                peak = max(peak, float(np.abs(total).max()))
                squares += float(np.vecdot(total, total))
        return {
            "drive_peak": peak,
            "drive_rms": float(np.sqrt(squares / (n_times * max(len(channels), 1)))),
            "share_outside_band": outside / energy if energy > 0.0 else np.nan,
        }

    def _of_drive(self, one: Placed, rate_hz: float, band_hz: Band | None) -> _Known:
        known = self._known.get(one.voice.id)
        if known is None or known.drive is not one.drive:
            samples = one.drive.samples
            known = self._known[one.voice.id] = _Known(
                one.drive,
                float(np.abs(samples).max(initial=0.0)),
                float(np.vecdot(samples, samples)),
                share_outside_band(samples, rate_hz, band_hz) if band_hz else np.nan,
            )
        return known


def _sum(inputs: list[tuple[float, Placed, _Known]], n_times: int) -> Floats:
    """What inputs at one place play together, (n_times,)."""
    total = np.zeros(n_times)
    for weight, one, _ in inputs:
        total[one.start : one.end] += weight * one.drive.samples
    return total
