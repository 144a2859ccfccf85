"""What clips play, as results tell it."""

from collections.abc import Mapping
from typing import Any

from skinsource.base.arrays import Floats


def waveforms_of(results: Mapping[str, Any]) -> dict[int, Floats]:
    """Samples of each clip that can be sampled, (n_times,), by its id.

    ``results`` have ``clip_waveforms``.
    """
    return {
        clip.id: samples
        for one, waveforms in zip(results["inputs"], results["clip_waveforms"], strict=True)
        for clip, samples in zip(one.clips, waveforms, strict=True)
        if samples is not None
    }
