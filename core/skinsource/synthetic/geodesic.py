"""How far a surface wave travels inside a hand, and which joints it crosses."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skinsource.arrays import Floats
from skinsource.hand.outline import HandShape
from skinsource.limb import N_INPUTS, N_OUTPUTS, VOLAR_OUTPUTS
from skinsource.locations import ARM_REGIONS, DIGITS, INPUTS, OUTPUTS


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Paths:
    """Paths from every input to every output.

    Attributes
    ----------
    lengths_px : (20, 72)
        Along the hand: a wave leaves a digit through its base knuckle and reaches the arm
        through the wrist.
    knuckles : (20, 72)
        How many base knuckles are crossed: 0, 1 or 2.
    wrists : (20, 72)
        Whether the wrist is crossed: 0 or 1.
    """

    lengths_px: Floats
    knuckles: Floats
    wrists: Floats


def paths_in(shape: HandShape) -> Paths:
    """Paths between all places of a hand."""
    outputs = shape.output_positions.copy()
    outputs[np.array(VOLAR_OUTPUTS) - 1] = shape.volar_positions
    digit_in = _digits([place.region for place in INPUTS])
    digit_out = _digits([place.region for place in OUTPUTS])
    on_arm = np.array([place.region in ARM_REGIONS for place in OUTPUTS])
    bases = np.array([axis[0] for axis in shape.digit_axes])

    leave = np.where((digit_in >= 0)[:, None], bases[digit_in], shape.input_positions)
    enter = np.where((digit_out >= 0)[:, None], bases[digit_out], outputs)
    first = _distances(shape.input_positions, leave)
    last = _distances(outputs, enter)
    across = _between(leave, enter, on_arm, shape.wrist_ends)
    lengths = first[:, None] + across + last[None, :]

    same = (digit_in[:, None] == digit_out[None, :]) & (digit_in >= 0)[:, None]
    direct = _distances(shape.input_positions[:, None], outputs[None, :])
    crossings = (digit_in >= 0)[:, None].astype(float) + (digit_out >= 0)[None, :]
    return Paths(
        lengths_px=np.where(same, direct, lengths),
        knuckles=np.where(same, 0.0, crossings),
        wrists=np.broadcast_to(on_arm.astype(float), (N_INPUTS, N_OUTPUTS)),
    )


def _digits(regions: list[str]) -> NDArray[np.int64]:
    """Number of the digit (0 to 4) of each region, -1 for the hand and the arm."""
    names = [f"digit {digit}" for digit in DIGITS]
    return np.array([names.index(region) if region in names else -1 for region in regions])


def _distances(start: Floats, stop: Floats) -> Floats:
    return np.asarray(np.linalg.norm(stop - start, axis=-1))


def _between(leave: Floats, enter: Floats, on_arm: NDArray[np.bool_], ends: Floats) -> Floats:
    """Straight within the hand; to the arm through the nearest place of the wrist, (20, 72)."""
    start, stop = leave[:, None, :], enter[None, :, :]
    straight = _distances(start, stop)
    # The wrist line is level, so a straight line crosses it at this share of its height.
    level = ends[0, 1]
    drop = np.where(on_arm, start[..., 1] - stop[..., 1], 1.0)
    share = (start[..., 1] - level) / drop
    x = np.clip(start[..., 0] + share * (stop[..., 0] - start[..., 0]), ends[0, 0], ends[1, 0])
    gate = np.stack([x, np.full_like(x, level)], axis=-1)
    return np.where(on_arm, _distances(start, gate) + _distances(gate, stop), straight)
