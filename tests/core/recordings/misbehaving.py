"""What a reader may do on a damaged file; functions for `run_limited`."""

import os
import time
from pathlib import Path

import numpy as np

from skinsource.base.errors import StorageError


def crash(path: Path):
    os.abort()


def end(path: Path):
    os._exit(0)


def hang(path: Path):
    time.sleep(60)


def fail(path: Path):
    raise LookupError("no such thing.")


def fail_clearly(path: Path):
    raise StorageError(f"{path.name}: is away, expected it here.")


def fill_the_memory(path: Path):
    content = np.ones(300 * 2**17)  # bytes of which each is used
    time.sleep(60)
    return content.sum()


def give_without_end(path: Path):
    while True:
        yield np.zeros(2**16)


def answer_with_nonsense(path: Path):
    return 2.0 ** np.arange(3, dtype=np.float16)


def print_much(path: Path, times: int):
    os.write(1, b"hello from a library\n" * times)
    return [str(path.name), times]


def give_arrays(path: Path):
    yield np.arange(6, dtype=np.float32).reshape(2, 3)
    yield {"a": [1.5, None]}
    yield np.arange(6.0)[::2]
    yield np.zeros((2, 0))
    yield np.array([2**32 - 1], np.uint32)
