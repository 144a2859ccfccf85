"""Noise that is one function of time, whatever the rate, the shift and the length."""

import numpy as np
import scipy

from skinsource.arrays import Complexes, Floats
from skinsource.formula.exact import Grid

#: Of the noise; so it seldom passes 1.
RMS = 1 / 3
LARGEST_SEED = 2**31 - 1
_BLOCK_S = 2.0
_HOP_S = 1.0
# The band is part of the function, not of a limb: a formula is the same wherever it is played.
# Tones stand 1 / block apart.  The window widens each by some hertz, so the outermost stay inside
# 25 to 600 Hz.
_LOWEST, _HIGHEST = 56, 1194


def band_noise(seed: int, grid: Grid) -> Floats:
    """Gaussian noise of RMS 1/3 from 28 to 597 Hz at the samples of ``grid``, (count,).

    It is a sum of blocks of 2 s, one begun each second and each faded in and out so that the power
    stays; a block is a sum of tones, every 0.5 Hz, with amplitudes and phases drawn from the seed
    and the number of the block.  So it is a function of continuous time: sampled faster, later by
    a part of a sample, or for longer, it is the same noise; outside 25 to 600 Hz lies less than
    1e-8 of its energy.  At a rate of 1200 Hz or less the tones that do not fit below half the rate
    are left out.
    """
    instants = grid.instants
    found = np.zeros(grid.count)
    if not grid.count:
        return found
    first, last = int(np.floor(instants[0])) - 1, int(np.floor(instants[-1]))
    highest = min(_HIGHEST, int(np.ceil(_BLOCK_S * grid.rate_hz / 2)) - 1)
    for block in range(first, last + 1):
        since = instants - block * _HOP_S
        begin, end = np.searchsorted(since, (0.0, _BLOCK_S))
        if begin == end or highest < _LOWEST:
            continue
        part = since[begin:end]
        fade = np.sin(np.pi / 2 * np.sin(np.pi / _BLOCK_S * part) ** 2)
        tones = _tones(seed, block)[: highest - _LOWEST + 1]
        found[begin:end] += fade * _sum_of_tones(tones, part, grid.rate_hz)
    return found


def _tones(seed: int, block: int) -> Complexes:
    """Complex amplitudes of the tones of a block from -2 on, (n_tones,)."""
    drawn = np.random.default_rng((seed, block + 2)).standard_normal((_HIGHEST - _LOWEST + 1, 2))
    return (drawn[:, 0] + 1j * drawn[:, 1]) * (RMS / np.sqrt(len(drawn)))


def _sum_of_tones(tones: Complexes, since: Floats, rate_hz: float) -> Floats:
    """Sum of the tones of a block at equally spaced times since its beginning, (n_times,).

    By Bluestein's convolution, which takes any rate.  Its chirp is reduced to one turn by a
    remainder, which is exact.
    """
    n, m = len(since), len(tones)
    lag = np.arange(-(m - 1), n)
    turns = np.fmod(lag.astype(float) ** 2, 2 * _BLOCK_S * rate_hz) / (2 * _BLOCK_S * rate_hz)
    chirp = np.exp(2j * np.pi * turns)
    number = np.arange(m)
    # Begun at the first of the times, and each tone relative to the lowest.
    begun = tones * np.exp(2j * np.pi * np.fmod(number * since[0] / _BLOCK_S, 1.0))
    size = scipy.fft.next_fast_len(n + 2 * m)
    left = scipy.fft.fft(begun * chirp[m - 1 :: -1][:m], size)
    right = scipy.fft.fft(np.conj(chirp), size)
    summed = scipy.fft.ifft(left * right)[m - 1 : m - 1 + n] * chirp[m - 1 :]
    lowest = np.exp(2j * np.pi * np.fmod(_LOWEST * since / _BLOCK_S, 1.0))
    return np.asarray((summed * lowest).real)
