"""Makes data/bench-references.npz: responses of the scenes of ``skinsource bench``, exactly.

Responses and drives are whole numbers and amplitudes are fractions, so the convolution at any
sample is a fraction that Python computes without rounding.  No engine is involved.  Each value is
stored as the nearest float64 and the rest as float32.

    PYTHONPATH=core python tests/references/comparison/make_references.py

Then write the list of data files anew: PYTHONPATH=core python tests/core/test_shipped_files.py
"""

import io
from fractions import Fraction

import numpy as np

from skinsource.files import write_bytes
from skinsource.files.assets import data_folder
from skinsource.limb import N_TAPS
from skinsource.method_comparison.made_up import (
    DRIVE_EXPONENT,
    RESPONSE_EXPONENT,
    whole_drive,
    whole_response,
)
from skinsource.method_comparison.references import FILE_NAME, WINDOW_SAMPLES
from skinsource.method_comparison.scenes import SCENES, ComparedScene

MOST_WINDOWS, SAMPLES_PER_WINDOW = 24, 8
HALF_BITS = 20
SEED = 5


def window_starts(scene: ComparedScene) -> np.ndarray:
    """First samples of some windows, evenly spread, the first and the last among them."""
    count = -(-scene.response_samples // WINDOW_SAMPLES)
    chosen = np.linspace(0, count - 1, min(count, MOST_WINDOWS)).astype(int)
    return chosen * WINDOW_SAMPLES


def halves(whole: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Upper and lower 20 bits: sums of products of halves fit 64 bits."""
    return whole >> HALF_BITS, whole & (2**HALF_BITS - 1)


def whole_convolution(response: np.ndarray, drive: np.ndarray, first: int, n: int) -> np.ndarray:
    """Samples ``first`` to ``first + n`` of the convolution, (n_channels, n), Python integers."""
    padded = np.zeros(n + N_TAPS - 1, np.int64)
    begin = first - (N_TAPS - 1)
    piece = drive[max(begin, 0) : max(first + n, 0)]
    offset = max(-begin, 0)
    padded[offset : offset + piece.size] = piece
    # Row t holds the drive t samples before each sample of the window.
    delayed = np.array([padded[N_TAPS - 1 - tap : N_TAPS - 1 - tap + n] for tap in range(N_TAPS)])
    total = np.zeros((len(response), n), object)
    for weight, part in zip((2**HALF_BITS, 1), halves(response), strict=True):
        for other, piece in zip((2**HALF_BITS, 1), halves(delayed), strict=True):
            total += (part @ piece).astype(object) * (weight * other)
    return total


def exact_window(scene: ComparedScene, which: np.ndarray, first: int, n: int) -> np.ndarray:
    """Exact response at ``n`` samples, (n_channels, n), as fractions."""
    total = np.zeros((which.size, n), object)
    for player in scene.players:
        if first + n <= player.start or first >= player.start + player.n_times + N_TAPS - 1:
            continue
        response = whole_response(player.location).reshape(-1, N_TAPS)[which]
        drive = whole_drive(player.seed, player.n_times)
        samples = whole_convolution(response, drive, first - player.start, n)
        total = total + samples * Fraction(player.amplitude)
    return total * (Fraction(2) ** (RESPONSE_EXPONENT + DRIVE_EXPONENT))


def reference_of(scene: ComparedScene, starts: np.ndarray) -> dict[str, np.ndarray]:
    """Arrays as `skinsource.method_comparison.references.load_reference` reads them."""
    which = np.array(scene.limb.checked_channels)
    shape = which.size, starts.size, SAMPLES_PER_WINDOW
    offsets = np.zeros(shape, np.uint8)
    high, low = np.zeros(shape), np.zeros(shape, np.float32)
    peaks = np.zeros(shape[:2])
    random = np.random.default_rng(SEED)
    for w, first in enumerate(starts):
        n = min(WINDOW_SAMPLES, scene.response_samples - first)
        exact = exact_window(scene, which, int(first), int(n))
        for c, row in enumerate(exact):
            largest = max(range(n), key=lambda k, row=row: abs(row[k]))
            peaks[c, w] = float(abs(row[largest]))
            offsets[c, w] = [largest, *random.integers(0, n, SAMPLES_PER_WINDOW - 1)]
            values = [Fraction(row[k]) for k in offsets[c, w]]
            high[c, w] = [float(value) for value in values]
            low[c, w] = [float(value - Fraction(float(value))) for value in values]
    return {
        "channels": which.astype(np.uint8),
        "starts": starts.astype(np.int32),
        "offsets": offsets,
        "peaks": peaks,
        "high": high,
        "low": low,
    }


def main() -> None:
    """Write the file."""
    arrays = {}
    for scene in SCENES:
        if scene.reference == scene.key:
            for name, array in reference_of(scene, window_starts(scene)).items():
                arrays[f"{scene.key}/{name}"] = array
    content = io.BytesIO()
    np.savez_compressed(content, **arrays)
    write_bytes(data_folder() / FILE_NAME, content.getvalue())


if __name__ == "__main__":
    main()
