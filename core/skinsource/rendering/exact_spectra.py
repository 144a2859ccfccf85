"""Spectra over exactly the samples of a response, of one voice.

They are taken over as many samples as there are, as upstream does, which is seldom a fast length
(1821 = 3 x 607).  The spectrum of a convolution is the product of those of drive and response;
those of responses stay the same when the drive changes, so that one transform is left of many.
"""

from collections.abc import Callable, Hashable

import numpy as np

from skinsource.arrays import Complexes, Floats
from skinsource.rendering.budgets import EXACT_SPECTRA_BYTES
from skinsource.rendering.channels import Channel, driven
from skinsource.rendering.memory import Memory
from skinsource.rendering.transforms import forward


class ExactSpectra:
    """Spectra of single responses at exact lengths, in bounded memory."""

    def __init__(self) -> None:
        self._known = Memory[Complexes](EXACT_SPECTRA_BYTES, lambda spectrum: spectrum.nbytes)

    def of(
        self, samples: Floats, taps: Floats, name: Hashable, n_times: int
    ) -> Callable[[list[Channel]], Complexes]:
        """Return a function from channels to spectra, (n_channels, n_times // 2 + 1).

        Parameters
        ----------
        samples
            The drive; its response ends within ``n_times``.
        taps : (n_outputs, 3 axes, n_taps)
            Responses to the place of the drive.
        name
            What the responses are remembered under.
        """

        def spectra(channels: list[Channel]) -> Complexes:
            drive = forward(samples, n_times)
            return driven(self._responses(taps, name, n_times, channels), drive)

        return spectra

    def _responses(
        self, taps: Floats, name: Hashable, n_times: int, channels: list[Channel]
    ) -> Complexes:
        keys = [(name, n_times, channel) for channel in channels]
        found = {key: self._known.find(key) for key in keys}
        missing = [key for key in keys if found[key] is None]
        if missing:
            rows = np.array([taps[output - 1, axis] for _, _, (output, axis) in missing])
            for key, spectrum in zip(missing, forward(rows, n_times), strict=True):
                found[key] = spectrum
                self._known.add(key, spectrum)
        return np.array([found[key] for key in keys])
