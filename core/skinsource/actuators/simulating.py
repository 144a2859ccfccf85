"""Motion under a sampled voltage, exactly as it is held between the samples."""

from fractions import Fraction
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from skinsource.actuators.equations import OUTPUTS, Equations
from skinsource.actuators.motion import ActuatorMotion
from skinsource.actuators.stepping import BLOCK, HOLDS, Hold, Level, Steps, steps
from skinsource.arguments import finite_array, one_of, positive_number
from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError
from skinsource.signals import MAX_SAMPLES
from skinsource.work import tally

#: Blocks that are worked on at once: a few megabytes.
_AT_ONCE = 2**12


def simulated(
    equations: Equations, voltage: ArrayLike, sample_rate_hz: float, hold: Hold
) -> ActuatorMotion:
    """Motion at the samples of a voltage, (n_times,), from rest.

    A sum over blocks of samples and over blocks of blocks: each step is exact, and rounding grows
    with the logarithm of their number.
    """
    samples = samples_of(voltage, hold)
    tally(samples_moved=samples.size)
    n_steps = max(samples.size - 1, 0)
    known = _steps_for(equations, step_of(sample_rate_hz), hold, _levels_for(n_steps))
    # At rest, but what the first sample passes on at once.
    found = np.empty((len(OUTPUTS), samples.size))
    found[:, :1] = np.outer([float(part) for part in equations.passed], samples[:1])
    if n_steps:
        with np.errstate(over="ignore", invalid="ignore"):
            _fill(found[:, 1:], samples, known)
    if not np.isfinite(found).all():
        raise InvalidInputError(
            "the motion is beyond all floating-point numbers; lower the voltage, or move the "
            "parameters nearer to those of real actuators"
        )
    return ActuatorMotion(**dict(zip(OUTPUTS, found, strict=True)))


def samples_of(voltage: ArrayLike, hold: Hold) -> Floats:
    """The voltage as one row of floats; refuses what is none, and holds that are not known."""
    samples = finite_array("voltage", voltage, "finite numbers in V, (n_times,)")
    if samples.ndim != 1 or samples.size > MAX_SAMPLES:
        raise InvalidInputError(
            f"voltage has the shape {samples.shape}, expected (n_times,) of at most {MAX_SAMPLES}"
        )
    one_of("hold", hold, HOLDS)
    return samples


def step_of(sample_rate_hz: float) -> Fraction:
    """Time between two samples, exactly."""
    return 1 / Fraction(positive_number("sample_rate_hz", sample_rate_hz))


# A drag of what is played leaves the actuator as it is; some tens of kilobytes each.
@lru_cache(maxsize=8)
def _steps_for(equations: Equations, step_s: Fraction, hold: Hold, n_levels: int) -> Steps:
    return steps(equations, step_s, hold, BLOCK**n_levels)


def _levels_for(n_steps: int) -> int:
    """Levels of blocks that so many steps take."""
    found = 0
    while n_steps >= BLOCK:
        found, n_steps = found + 1, n_steps // BLOCK
    return found


def _fill(found: Floats, samples: Floats, known: Steps) -> None:
    """Outputs after each step, (4, n_steps)."""
    n_steps = found.shape[1]
    n_blocks = -(-n_steps // BLOCK)
    padded = np.zeros(n_blocks * BLOCK + 1)
    padded[: samples.size] = samples
    blocks = np.lib.stride_tricks.sliding_window_view(padded, BLOCK + 1)[::BLOCK]
    parts = [slice(start, start + _AT_ONCE) for start in range(0, n_blocks, _AT_ONCE)]
    ends = np.concatenate([blocks[part] @ known.end for part in parts])
    # Before each block: what all blocks before it have left.
    before = np.zeros_like(ends)
    before[1:] = _accumulated(ends, known.levels)[:-1]
    for part in parts:
        outputs = blocks[part] @ known.driven + before[part] @ known.carried
        first = part.start * BLOCK
        taken = outputs.reshape(-1, len(OUTPUTS))[: n_steps - first]
        found[:, first : first + len(taken)] = taken.T


def _accumulated(added: Floats, levels: tuple[Level, ...]) -> Floats:
    """States after each step from what each step adds, both (n_steps, n_states), from rest."""
    if len(added) == 1:
        return added
    level, *above = levels
    n_steps, n_states = added.shape
    n_blocks = -(-n_steps // BLOCK)
    blocks = np.zeros((n_blocks, BLOCK * n_states))
    blocks.reshape(-1, n_states)[:n_steps] = added
    found = blocks @ level.added
    ends = _accumulated(found[:, -n_states:], tuple(above))
    found[1:] += ends[:-1] @ level.carried
    states: Floats = found.reshape(-1, n_states)[:n_steps]
    return states
