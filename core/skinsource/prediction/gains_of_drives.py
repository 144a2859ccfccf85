"""Gains of any samples at places of limbs, which are searched for once."""

from collections.abc import Sequence
from hashlib import sha256
from sys import getsizeof
from threading import Lock
from weakref import ref

from skinsource.arrays import Complexes
from skinsource.chain import Drive
from skinsource.limb import Limb
from skinsource.rendering.budgets import PREDICT_GAINS_BYTES
from skinsource.rendering.gains import unit_gains
from skinsource.rendering.memory import Memory
from skinsource.rendering.response_spectra import ResponseSpectrum


class GainsOfDrives:
    """Gains of drives at places, in bounded memory, for all threads."""

    def __init__(self) -> None:
        self._known = Memory[float](PREDICT_GAINS_BYTES, getsizeof)
        self._lock = Lock()

    def of(
        self,
        limb: Limb,
        places: Sequence[int],
        drives: Sequence[Drive],
        spectra: Sequence[Complexes],
        responses: Sequence[ResponseSpectrum],
    ) -> list[float]:
        """Gain of each drive at its place; arguments as those of `unit_gains`."""
        keys = [
            (
                ref(limb),
                place,
                response.n_fft,
                drive.factor,
                sha256(drive.samples.tobytes()).digest(),
            )
            for place, drive, response in zip(places, drives, responses, strict=True)
        ]
        with self._lock:
            known = {key: gain for key in keys if (gain := self._known.find(key)) is not None}
        missing = {key: k for k, key in enumerate(keys) if key not in known}
        new = list(missing.values())
        if new:
            found = unit_gains(
                [drives[k] for k in new],
                [spectra[k] for k in new],
                [responses[k] for k in new],
                # Bounds by frequency cost more to prepare than the channels that they spare.
                tight=False,
            )
            known |= zip(missing, found, strict=True)
            with self._lock:
                for key in missing:
                    if self._known.find(key) is None:
                        self._known.add(key, known[key])
        return [known[key] for key in keys]
