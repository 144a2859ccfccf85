"""How wrong the traces are: some samples computed again, exactly; and how wrong they can be."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from skinsource.arrays import Complexes, Floats
from skinsource.chain import Drive
from skinsource.job import Stop
from skinsource.rendering.bounds import rounding_bound
from skinsource.rendering.gains import is_positive
from skinsource.rendering.maxima import peaks_of
from skinsource.rendering.response_spectra import ResponseSpectrum

#: Samples that are computed again, and the factor from their largest error to the estimate.
N_SAMPLES, ESTIMATE_FACTOR = 64, 4.0
# Drawn to find enough where something moves; checked wherever they fall.
_N_DRAWN, _N_ANYWHERE = 4096, 16


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceError:
    """Error of the traces, relative to their largest sample.

    Attributes
    ----------
    estimate
        Four times the largest error among 64 samples that were computed again, as sums of products
        in extended precision.
    bound
        What no sample exceeds.
    """

    estimate: float
    bound: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Heard:
    """A voice as the check sees it.

    ``weight`` is what the vibration by the scaled samples is multiplied with.
    """

    drive: Drive
    delay_samples: int
    weight: float
    response: ResponseSpectrum

    def exact(self, output: int, axis: int, time: int) -> np.longdouble:
        """One sample of the vibration, by its definition."""
        taps = self.response.taps[output - 1, axis]
        last = time - self.delay_samples
        first = max(last - taps.size + 1, 0)
        piece = self.drive.samples[first : max(last + 1, 0)].astype(np.longdouble)
        products = piece * taps[last - first - piece.size + 1 : last - first + 1][::-1]
        return np.longdouble(self.weight) * products.sum()

    def rounding(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> float:
        """Size of the products whose rounding adds up, in the strongest of some channels."""
        energies = self.response.norms.energies.reshape(self.response.taps.shape[:2])
        strongest = energies[[output - 1 for output in outputs]][:, list(axes)].max()
        return float(abs(self.weight) * np.linalg.norm(self.drive.samples) * strongest)


def exact_gains(
    drives: Sequence[Drive],
    spectra: Sequence[Complexes],
    responses: Sequence[ResponseSpectrum],
    stop: Stop,
) -> list[float]:
    """Gains as `skinsource.rendering.gains.unit_gains`, from maxima computed by definition.

    Transforms say where a maximum is, not how large.
    """
    peaks = peaks_of([drive.samples for drive in drives], spectra, responses, stop)
    gains = []
    for drive, response, peak in zip(drives, responses, peaks, strict=True):
        one = Heard(drive=drive, delay_samples=0, weight=1.0, response=response)
        output, axis = divmod(peak.channel, response.taps.shape[1])
        value = float(one.exact(output + 1, axis, peak.time))
        positive = is_positive(peak, drive, response) and value > 0.0
        gains.append(1.0 / value if positive else drive.factor)
    return gains


def _checked_places(samples: Floats) -> list[int]:
    """Random places, most of them where there is something to be wrong: long designs rest a lot."""
    drawn = np.random.default_rng(0).integers(0, samples.size, _N_DRAWN)
    sounding = drawn[samples[drawn] != 0.0][: N_SAMPLES - _N_ANYWHERE]
    return [*sounding.tolist(), *drawn[: N_SAMPLES - sounding.size].tolist()]


def trace_error_of(
    traces: Floats, outputs: tuple[int, ...], axes: tuple[int, ...], heard: list[Heard]
) -> TraceError | None:
    """Check ``traces``, (n_outputs, n_axes, n_times); None where there is nothing to check."""
    peak = float(np.abs(traces).max(initial=0.0))
    if peak == 0.0 or not heard:
        return None
    worst = np.longdouble(0.0)
    for place in _checked_places(traces.reshape(-1)):
        row, column, time = np.unravel_index(int(place), traces.shape)
        exact = sum(
            (one.exact(outputs[row], axes[column], int(time)) for one in heard), np.longdouble(0.0)
        )
        worst = max(worst, abs(exact - np.longdouble(traces[row, column, time])))
    n_fft = max(one.response.n_fft for one in heard)
    norms = sum(one.rounding(outputs, axes) for one in heard)
    return TraceError(
        estimate=float(ESTIMATE_FACTOR * worst / peak),
        bound=rounding_bound(norms, n_fft) / peak,
    )
