"""What the tests of playing share."""

import threading

import numpy as np

from skinsource.lab.playing.stream import Mix, PlayQueue, mix_of, next_block

RATE_HZ = 8000
#: Samples of a fade at that rate, and of the fall to silence.
FADE, FALL = 40, 8


def mix(rows, *, loop=None, n_outputs=None, rate_hz=RATE_HZ) -> Mix:
    """A mix of rows, one output each; the loop in samples."""
    rows = np.atleast_2d(np.asarray(rows, float))
    return mix_of(
        rows,
        rate_hz,
        outputs=range(1, rows.shape[0] + 1),
        titles=[f"place {k + 1}" for k in range(rows.shape[0])],
        n_outputs=n_outputs or rows.shape[0],
        loop_s=None if loop is None else (loop[0] / rate_hz, loop[1] / rate_hz),
    )


def tone(n, cycles=10.0, amplitude=0.5):
    """A tone that begins and ends at zero."""
    return amplitude * np.sin(2 * np.pi * cycles * np.arange(n) / n)


def play_queue(n_outputs=1, gain_db=0.0) -> PlayQueue:
    return PlayQueue(n_outputs, RATE_HZ, gain_db)


def block(of, n) -> np.ndarray:
    """The next samples, (n_outputs, n), as the device gets them."""
    out = np.full((n, of.n_outputs), np.nan, np.float32)
    next_block(of, out)
    return out.T


def blocks(of, sizes) -> np.ndarray:
    """The next blocks, one behind the other, (n_outputs, n_times)."""
    return np.concatenate([block(of, n) for n in sizes], axis=1)


def playing(of_mix, *, at=0, gain_db=0.0, n_outputs=None):
    """A queue that plays a mix from a sample on."""
    queue = play_queue(n_outputs or of_mix.n_outputs, gain_db)
    queue.play(of_mix, at)
    return queue


def wait_for(condition):
    """Until it holds; the thread of the device runs meanwhile."""
    pause = threading.Event()
    assert any(condition() or pause.wait(0.005) for _ in range(4000))
