"""Exact responses of scenes on any limb: the sum of products itself, in whole numbers.

The drives are whole numbers, the responses floats, and a float is a whole number times a power of
two.  Both are cut into pieces of 20 bits: sums of some thousand products of pieces are whole
numbers that float64 holds, so matrix products give them without rounding, and the rest is Python's
arithmetic of whole numbers and fractions.  No engine is involved, and nothing is transformed.
"""

import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from skinsource.arrays import Floats, Integers
from skinsource.errors import InvalidInputError
from skinsource.files import write_bytes
from skinsource.method_comparison.made_up import DRIVE_EXPONENT, whole_drive
from skinsource.method_comparison.references import Reference
from skinsource.method_comparison.scenes import ComparedScene, Player
from skinsource.signals import sample_count

#: The file of exact values, beside table and report.
EXACT_NAME = "exact_values.npz"
#: As in the references that come with the program.
MOST_WINDOWS, SAMPLES_PER_WINDOW, WINDOW_S = 24, 8, 0.1
#: Samples of a window that are looked at for its largest, evenly spread where it has more.
MOST_LOOKED_AT = 512
_SEED = 5
_PIECE_BITS, _RESPONSE_PIECES = 20, 6
#: As many products of two pieces sum up to less than 2^53.
_MOST_SUMMED = 4096

#: Whole numbers of any size, or fractions.
Exact = NDArray[np.object_]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Played:
    """One input, and the responses to it that are checked.

    Attributes
    ----------
    player
        The input.
    drive : (n_times,)
        What it plays before its amplitude, in 2^-39.
    taps : (n_channels, n_taps)
        m/s².
    """

    player: Player
    drive: Integers
    taps: Floats

    def delayed(self, first: int, n: int) -> Integers:
        """What is multiplied with the taps at ``n`` samples, (n, n_taps), last tap first.

        Empty, (0, n_taps), where the drive does not reach.
        """
        n_taps = self.taps.shape[-1]
        begin = first - self.player.start - (n_taps - 1)
        end = begin + n + n_taps - 1
        if end <= 0 or begin >= self.drive.size:
            return np.zeros((0, n_taps), np.int64)
        piece = self.drive[max(begin, 0) : end]
        before, after = max(-begin, 0), max(end - self.drive.size, 0)
        return sliding_window_view(np.pad(piece, (before, after)), n_taps)


def write_references(path: Path, references: Mapping[str, Reference]) -> None:
    """Write exact values, by their keys, as `skinsource.method_comparison.references` reads them.

    Raises
    ------
    StorageError
        The file cannot be written.
    """
    arrays: dict[str, Any] = {}
    for key, one in references.items():
        arrays[f"{key}/channels"], arrays[f"{key}/starts"] = one.channels, one.starts
        arrays[f"{key}/offsets"] = one.samples - one.starts[None, :, None]
        arrays[f"{key}/peaks"] = one.peaks
        arrays[f"{key}/high"], arrays[f"{key}/low"] = one.high, one.low
    content = io.BytesIO()
    np.savez_compressed(content, **arrays)
    write_bytes(path, content.getvalue())


def exact_response(scene: ComparedScene) -> Reference:
    """The response at chosen samples of the checked channels: always the same ones.

    Raises
    ------
    InvalidInputError
        A response holds what is no finite number.
    SkinSourceError
        The limb cannot be read.
    """
    window = max(sample_count(WINDOW_S, scene.limb.sample_rate_hz), 1)
    starts = _window_starts(scene.response_samples, window)
    lengths = np.minimum(window, scene.response_samples - starts)
    steps = -(-lengths // MOST_LOOKED_AT)
    offsets = _chosen(scene, starts, lengths, steps)
    samples = starts[None, :, None] + offsets
    reached = np.zeros(starts.size, bool)
    exact: Exact = np.full(samples.shape, Fraction(0), object)
    left_out = np.zeros(samples.shape[0])
    for played in _all_played(scene):
        pieces, exponent, rest = _pieces_of(played.taps)
        amplitude = Fraction(played.player.amplitude)
        unit = amplitude * Fraction(2) ** (exponent + DRIVE_EXPONENT)
        for w, (first, n) in enumerate(zip(starts, lengths, strict=True)):
            delayed = played.delayed(int(first), int(n))
            if delayed.size == 0:
                continue
            reached[w] = True
            some, place = np.unique(offsets[:, w], return_inverse=True)
            sums = _whole_sums(pieces, delayed[some]) * unit
            rows = np.arange(len(sums))[:, None]
            exact[:, w] += sums[rows, place.reshape(offsets[:, w].shape)]
        left_out += float(abs(amplitude)) * rest * min(played.drive.size, played.taps.shape[-1])
    return _reference(scene, starts, samples, exact, reached, left_out)


def _reference(
    scene: ComparedScene,
    starts: Integers,
    samples: Integers,
    exact: Exact,
    reached: NDArray[np.bool_],
    left_out: Floats,
) -> Reference:
    high = exact.astype(np.float64)
    low = (exact - _fractions(high)).astype(np.float64)
    peaks = np.abs(high).max(axis=2)
    # Zero says that nothing can arrive.  Where a response is zero although something plays, an
    # engine has not promised that.
    peaks[:, reached] = np.maximum(peaks[:, reached], np.finfo(np.float64).tiny)
    channel_peaks = peaks.max(axis=1)
    # What is left over after the nearest float64 and its rest is less than 2^-106 of a value.
    bound = 2.0**-106 + float((left_out / channel_peaks).max())
    return Reference(
        channels=np.array(scene.limb.checked_channels),
        starts=starts,
        samples=samples,
        peaks=peaks,
        high=high,
        low=low,
        bound=bound,
    )


def _fractions(values: Floats) -> Exact:
    found: Exact = np.empty(values.shape, object)
    found.ravel()[:] = [Fraction(float(value)) for value in values.ravel()]
    return found


def _window_starts(response_samples: int, window: int) -> Integers:
    """First samples of some windows, evenly spread, the first and the last among them."""
    count = -(-response_samples // window)
    chosen = np.linspace(0, count - 1, min(count, MOST_WINDOWS)).astype(np.int64)
    return chosen * window


def _chosen(scene: ComparedScene, starts: Integers, lengths: Integers, steps: Integers) -> Integers:
    """Which samples of each window: its largest and some more, (n_channels, n_windows, n)."""
    totals: list[Floats] = [
        np.zeros((len(scene.limb.checked_channels), -(-int(n) // int(step))))
        for n, step in zip(lengths, steps, strict=True)
    ]
    for played in _all_played(scene):
        backwards = played.taps[:, ::-1]
        for total, first, n, step in zip(totals, starts, lengths, steps, strict=True):
            delayed = played.delayed(int(first), int(n))[:: int(step)]
            if delayed.size:
                weights = np.ldexp(played.player.amplitude * backwards, DRIVE_EXPONENT)
                total += sum(_summed(weights, delayed))
    random = np.random.default_rng(_SEED)
    largest = np.stack(
        [np.abs(total).argmax(axis=1) * step for total, step in zip(totals, steps, strict=True)],
        axis=1,
    )
    more = random.integers(0, lengths[:, None], (starts.size, SAMPLES_PER_WINDOW - 1))
    others = np.broadcast_to(more, (len(largest), *more.shape))
    return np.concatenate((largest[..., None], others), axis=2)


def _all_played(scene: ComparedScene) -> Iterator[_Played]:
    """Each input in turn; no more than the responses to one place are held."""
    channels = np.array(scene.limb.checked_channels)
    for player in scene.players:
        response = scene.limb.load().response_to(player.location)
        taps = response.reshape(-1, scene.limb.n_taps)[channels]
        if not np.isfinite(taps).all():
            raise InvalidInputError(
                f"{scene.limb.name}: a response to input location {player.location} is not finite, "
                "so there are no exact values. Install or load the limb again."
            )
        yield _Played(player=player, drive=whole_drive(player.seed, player.n_times), taps=taps)


def _pieces_of(taps: Floats) -> tuple[Sequence[Floats], int, Floats]:
    """Cut taps into pieces of 20 bits, most significant first.

    Returns
    -------
    pieces
        Each as ``taps``, whole numbers; last tap first, as drives are.
    exponent
        Of the last piece's unit, a power of two.
    rest : (n_channels,)
        What all of them leave out of a tap at most: nothing of taps down to 2^-67 of the largest.
    """
    _, exponent = np.frexp(np.abs(taps).max())
    left = np.ldexp(taps[:, ::-1], -int(exponent))
    pieces: list[Floats] = []
    while len(pieces) < _RESPONSE_PIECES:
        left = np.ldexp(left, _PIECE_BITS)
        piece = np.trunc(left)
        # What is cut off is held by a float as well: this is exact.
        left = left - piece
        pieces.append(piece)
    unit = int(exponent) - _PIECE_BITS * len(pieces)
    return pieces, unit, np.ldexp(np.abs(left).max(axis=1), unit)


def _whole_sums(pieces: Sequence[Floats], delayed: Integers) -> Exact:
    """Sums of products of taps and drives, (n_channels, n), as whole numbers of any size."""
    total: Exact = np.zeros((len(pieces[0]), len(delayed)), object)
    halves = delayed >> _PIECE_BITS, delayed & (2**_PIECE_BITS - 1)
    for k, piece in enumerate(reversed(pieces)):
        for shift, half in zip((_PIECE_BITS, 0), halves, strict=True):
            if piece.any():
                for part in _summed(piece, half):
                    total += part.astype(np.int64).astype(object) * 2 ** (_PIECE_BITS * k + shift)
    return total


def _summed(weights: Floats, delayed: Integers) -> Iterator[Floats]:
    """Matrix product, (n_channels, n), in parts to be added up.

    Where both are whole numbers below 2^20, the parts are whole numbers below 2^53: exact.
    """
    for first in range(0, weights.shape[-1], _MOST_SUMMED):
        part = slice(first, first + _MOST_SUMMED)
        yield weights[:, part] @ delayed[:, part].astype(np.float64).T
