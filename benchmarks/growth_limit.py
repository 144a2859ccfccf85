"""The least time for the least work of an edit: what `growth.py` measures against.

The rates are the best this machine shows, one thread or two: reading a large float64 array, and
``scipy.fft.irfft`` of batches, counted as 2.5 n log2(n) operations for n samples.  Least work, with
S the spectra of the 216 responses to one place, for N inputs and P traces of selected outputs:

- everything: read the responses and N S; transform all responses, N drives, one channel per input
  (its exact maximum), and P traces, back to time and at their exact length;
- one waveform: read S, and the sum of the other inputs; transform one drive, one channel, and P
  traces, both ways;
- one amplitude: read the traces and spectra of two parts and write their sum.

A scene that is too long to be transformed at once is taken in blocks of 4096 samples: then
everything and one waveform read N S and transform N drives and 216 channels of each block.  What is
drawn, multiplied and summed is left out, so nothing can reach the limit.
"""

import math
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from time import perf_counter

import numpy as np
from scipy import fft

from skinsource.base.conventions import N_AXES, N_OUTPUTS, N_TAPS

CHANNELS = N_OUTPUTS * N_AXES
BLOCK_FFT, BLOCK_SAMPLES = 4096, 4096 - N_TAPS + 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Machine:
    """Best rates seen: bytes read per second, and operations of transforms per second."""

    read_rate: float
    transform_rate: float

    def better_of(self, other: "Machine") -> "Machine":
        """The best rates of two measurements: other programs slow some down."""
        return Machine(
            read_rate=max(self.read_rate, other.read_rate),
            transform_rate=max(self.transform_rate, other.transform_rate),
        )

    def least_ms(self, read_bytes: float, operations: float) -> float:
        """Least time for so much work."""
        return 1e3 * (read_bytes / self.read_rate + operations / self.transform_rate)


def fastest(action: Callable[[], object], repeats: int = 40) -> float:
    """Seconds of the fastest of some runs."""
    times = []
    for _ in range(repeats):
        begin = perf_counter()
        action()
        times.append(perf_counter() - begin)
    return min(times)


def this_machine() -> Machine:
    """Measure what the limit is made of."""
    large = np.ones(2**25)
    halves = np.split(large, 2)
    with ThreadPoolExecutor(2) as pool:
        read_s = min(
            fastest(lambda: large @ large),
            fastest(lambda: list(pool.map(lambda half: half @ half, halves))),
        )
    rates = []
    for n in (768, 1920, 4096):
        batch = np.ones((CHANNELS, n // 2 + 1), np.complex128)
        for threads in (1, 2):
            needed_s = fastest(lambda b=batch, n=n, t=threads: fft.irfft(b, n, workers=t))
            rates.append(CHANNELS * operations_of(n) / needed_s)
    return Machine(read_rate=large.nbytes / read_s, transform_rate=max(rates))


def operations_of(n: int) -> float:
    """Operations of a real transform of n samples, as it is usually counted."""
    return 2.5 * n * math.log2(n)


def least_work(
    edit: str, n_times: int, n_fft: int | None, inputs: int, outputs: int
) -> tuple[float, float]:
    """Bytes and operations of transforms that an edit cannot do without."""
    traces, n_block = N_AXES * outputs, n_fft or BLOCK_FFT
    if edit == "one amplitude":
        return 3 * traces * (8 * n_times + 16 * (n_times // 2 + 1)), 0.0
    spectra, operations = 16 * CHANNELS * (n_block // 2 + 1), operations_of(n_block)
    responses = inputs if edit == "everything" else 0
    moved = responses * CHANNELS * N_TAPS * 8
    work = responses * CHANNELS * operations + traces * operations_of(n_times)
    if n_fft is None:
        blocks = math.ceil(n_times / BLOCK_SAMPLES)
        return moved + inputs * spectra, work + blocks * (inputs + CHANNELS) * operations
    if edit == "everything":
        return moved + inputs * spectra, work + (2 * inputs + traces) * operations
    return 2 * spectra, work + (2 + traces) * operations
