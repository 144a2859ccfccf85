"""What SciPy offers: it transforms drives and responses anew at every call."""

import importlib
from collections.abc import Iterator
from functools import partial

from skinsource.method_comparison.accuracy import Block
from skinsource.method_comparison.method import (
    Method,
    Prepared,
    all_channels,
    drives_of,
    output_bytes,
    require_bytes,
    taps_of,
)
from skinsource.method_comparison.scenes import ComparedScene

#: The sum, one field, its padded transform and a product of transforms.
_COPIES = 4


def _prepare(name: str, scene: ComparedScene, method: Method) -> Prepared:
    require_bytes(_COPIES * output_bytes(scene, method))
    # A second of import that only these two engines pay for.
    convolve = getattr(importlib.import_module("scipy.signal"), name)
    taps, drives = taps_of(scene, method), drives_of(scene, method)

    def run(_: int) -> Iterator[Block]:
        total = convolve(taps[0], drives[:1], axes=-1)
        for response, drive in zip(taps[1:], drives[1:], strict=True):
            total += convolve(response, drive[None], axes=-1)
        yield 0, total

    return Prepared(rows=all_channels(scene), run=run)


prepare_fftconvolve = partial(_prepare, "fftconvolve")
prepare_oaconvolve = partial(_prepare, "oaconvolve")
