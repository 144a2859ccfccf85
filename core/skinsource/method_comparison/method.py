"""What an engine is given, and what it gives back."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from skinsource.arrays import Integers
from skinsource.method_comparison.accuracy import Block
from skinsource.method_comparison.made_up import made_up_drive
from skinsource.method_comparison.scenes import ComparedScene

Real = NDArray[np.floating]
Precision = Literal["float64", "float32"]

#: What an engine may hold at once.
LARGEST_BYTES = 2e9
_DB_PER_FACTOR_TEN = 20.0


class Unfit(Exception):
    """A method cannot compute a scene; the message says why."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Setting:
    """How an engine computes; what trades error for time.

    Attributes
    ----------
    name
        Words for people.
    cut_db
        Responses end where all of them stay below this level re their peak; None: whole.
    rank
        Responses are combinations of so many shapes; None: as they are.
    block
        Length of the transforms of an engine that works in blocks; None: what suits the responses.
    what
        ``"all"`` channels in time; ``"window"``: the map, and traces of at most six outputs;
        ``"library"``: all channels, by one call of the library that remembers nothing.
    promised
        Whether anything was promised for it.
    """

    name: str = "exact"
    cut_db: float | None = None
    rank: int | None = None
    block: int | None = None
    what: Literal["all", "window", "library"] = "all"
    promised: bool = True

    @property
    def is_exact(self) -> bool:
        """Whether nothing but rounding makes errors."""
        return self.promised and self.cut_db is None and self.rank is None


@dataclass(frozen=True, slots=True, kw_only=True)
class Method:
    """A precision and a setting of an engine.

    Attributes
    ----------
    in_quick
        Whether the short run includes it.
    """

    precision: Precision = "float64"
    setting: Setting = Setting()
    in_quick: bool = False


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Prepared:
    """An engine that is ready: all that does not depend on the drives is done.

    Attributes
    ----------
    rows : (n_rows,)
        Channel of each row of what comes out.
    run
        From the number of the run to the response, block by block.
    lent_bytes
        What is held only so that the runs cost no drawing: the program itself draws drives.
    """

    rows: Integers
    run: Callable[[int], Iterator[Block]]
    lent_bytes: int = 0


def all_channels(scene: ComparedScene) -> Integers:
    """Every channel of the limb, (n_channels,)."""
    return np.arange(scene.limb.n_channels)


def taps_of(scene: ComparedScene, method: Method) -> Real:
    """Responses to the place of each input, (n_inputs, n_channels, n_taps), cut where asked.

    Raises `Unfit` where they are too large.
    """
    require_bytes(response_bytes(scene))
    limb = scene.limb.load()
    taps = np.empty((len(scene.players), scene.limb.n_channels, scene.limb.n_taps))
    for row, player in zip(taps, scene.players, strict=True):
        row[:] = limb.response_to(player.location).reshape(row.shape)
    if method.setting.cut_db is not None:
        peak = np.abs(taps).max()
        lowest = peak * 10.0 ** (method.setting.cut_db / _DB_PER_FACTOR_TEN)
        taps = taps[..., : np.flatnonzero((np.abs(taps) >= lowest).any(axis=(0, 1)))[-1] + 1]
    return np.ascontiguousarray(taps, dtype=method.precision)


def spectra_of(taps: Real, n_fft: int) -> NDArray[np.complexfloating]:
    """Transforms of the responses, (n_inputs, n_channels, n_fft // 2 + 1).

    One input after the other: all at once would hold a padded copy of them all.
    """
    precision = np.result_type(taps.dtype, np.complex64)
    spectra = np.empty((*taps.shape[:2], n_fft // 2 + 1), precision)
    for row, response in zip(spectra, taps, strict=True):
        row[:] = fft.rfft(response, n_fft)
    return spectra


def drives_of(scene: ComparedScene, method: Method) -> Real:
    """What each input plays, amplitude and onset included, (n_inputs, n_stimulus)."""
    drives = np.zeros((len(scene.players), scene.stimulus_samples), method.precision)
    for row, player in zip(drives, scene.players, strict=True):
        samples = made_up_drive(player.seed, player.n_times) * player.amplitude
        row[player.start : player.start + player.n_times] = samples
    return drives


def require_bytes(needed: float) -> None:
    """Raise `Unfit` where an engine would hold more than `LARGEST_BYTES` at once."""
    if needed > LARGEST_BYTES:
        raise Unfit(
            f"would hold {needed / 1e9:.1f} GB at once; the limit is {LARGEST_BYTES / 1e9:.0f} GB"
        )


def output_bytes(scene: ComparedScene, method: Method) -> int:
    """Size of all channels of the response."""
    return scene.limb.n_channels * scene.response_samples * np.dtype(method.precision).itemsize


def response_bytes(scene: ComparedScene) -> int:
    """Size of the responses to all places that are played, as they are read."""
    places = {player.location for player in scene.players}
    return len(places) * scene.limb.n_channels * scene.limb.n_taps * np.dtype(np.float64).itemsize
