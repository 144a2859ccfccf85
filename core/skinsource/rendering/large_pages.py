"""Memory for spectra, which the system serves in large pages where it has such."""

import mmap
from math import prod

import numpy as np

from skinsource.arrays import Complexes

#: Linux begins memory of whole large pages where one begins.
_PAGE_BYTES = 2**21


def room_for(shape: tuple[int, ...]) -> Complexes:
    """Memory that is served when it is touched; what never is takes none.

    It comes from the system directly: memory that was in use before is all there, touched or not.
    In large pages it is there five times as soon, and sums over twenty places read it faster.
    """
    n_pages = -(-prod(shape) * np.dtype(np.complex128).itemsize // _PAGE_BYTES)
    n_bytes = max(n_pages, 1) * _PAGE_BYTES
    if hasattr(mmap, "MADV_HUGEPAGE"):
        # Linux gives large pages to private memory only, unless it was told otherwise.
        memory = mmap.mmap(-1, n_bytes, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
        memory.madvise(mmap.MADV_HUGEPAGE)
    else:
        memory = mmap.mmap(-1, n_bytes)
    return np.frombuffer(memory, np.complex128, prod(shape)).reshape(shape)
