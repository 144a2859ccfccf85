"""Made-up responses and drives in whole numbers: the same bits on every machine.

Measured responses may not be shipped, and computed ones differ in their last digits between
machines.  These are sums of damped resonances that arrive later and weaker farther away, made by
whole-number arithmetic, so that their convolutions are known exactly.
"""

import numpy as np

from skinsource.arrays import Floats, Integers
from skinsource.limb import N_AXES, N_INPUTS, N_OUTPUTS, N_TAPS, Limb, LimbMap

#: A response is its whole number times 2 to this power; so is a drive.
RESPONSE_EXPONENT = -36
DRIVE_EXPONENT = -39
_DRIVE_BITS = 40

# 2 r cos(w) and r² in units of 2^-24, for 60, 110, 180, 260, 370 and 520 Hz at 1300 Hz, with
# losses of 0.25, 0.28, 0.33, 0.4, 0.55 and 0.8 dB per sample.
_MODES = (
    (31241137, 15838713),
    (28005406, 15729680),
    (20830675, 15549624),
    (9902213, 15301003),
    (-6796253, 14781547),
    (-24757543, 13954680),
)
_MODE_SHIFT = 24
_MODE_START = 2**31
_GAIN_BITS = 8
_FIRST_ARRIVAL = 12
# Waves arrive softly: (1 + z)^8 / 2^8, which also takes away what lies above 500 Hz.
_SOFTENING = 8


def whole_response(location: int) -> Integers:
    """Response to input ``location``, (72 outputs, 3 axes, 522 taps), in 2^-36 m/s²."""
    count = N_OUTPUTS * N_AXES * len(_MODES)
    gains = _random_bits(1000 + location, count, _GAIN_BITS) - 2 ** (_GAIN_BITS - 1)
    shapes = gains.reshape(N_OUTPUTS * N_AXES, len(_MODES)) @ _ringing()
    shapes = shapes.reshape(N_OUTPUTS, N_AXES, N_TAPS)
    response = np.zeros_like(shapes)
    for output in range(N_OUTPUTS):
        delay = _FIRST_ARRIVAL + abs(output - 3 * location)
        response[output, :, delay:] = shapes[output, :, : N_TAPS - delay] // (8 + delay)
    return response


def whole_drive(seed: int, n_times: int) -> Integers:
    """Noise, (n_times,), in 2^-39: 40 bits each, so that products need more than a float holds."""
    return _random_bits(seed, n_times, _DRIVE_BITS) - 2 ** (_DRIVE_BITS - 1)


def made_up_drive(seed: int, n_times: int) -> Floats:
    """Noise of peak 1 at most, (n_times,): exactly `whole_drive`."""
    return np.ldexp(whole_drive(seed, n_times).astype(np.float64), DRIVE_EXPONENT)


def made_up_response(location: int) -> Floats:
    """Response to input ``location``, (72 outputs, 3 axes, 522 taps), m/s²."""
    return np.ldexp(whole_response(location).astype(np.float64), RESPONSE_EXPONENT)


def made_up_limb() -> Limb:
    """A limb of made-up responses, without a map."""
    nowhere = LimbMap(
        outline=np.zeros((0, 2)),
        output_positions=np.zeros((N_OUTPUTS, 2)),
        input_positions=np.zeros((N_INPUTS, 2)),
        hand_length_px=1.0,
    )
    return Limb(
        name="made-up",
        hand_length_mm=1.0,
        synthetic=True,
        map=nowhere,
        read_response=made_up_response,
    )


def _ringing() -> Integers:
    """Each damped resonance, (n_modes, 522)."""
    first, second = np.array(_MODES, np.int64).T
    ringing = np.zeros((len(_MODES), N_TAPS), np.int64)
    ringing[:, 0] = _MODE_START
    ringing[:, 1] = (first * ringing[:, 0]) >> _MODE_SHIFT
    for tap in range(2, N_TAPS):
        moved = first * ringing[:, tap - 1] - second * ringing[:, tap - 2]
        ringing[:, tap] = moved >> _MODE_SHIFT
    for _ in range(_SOFTENING):
        ringing[:, 1:] += ringing[:, :-1].copy()
    return ringing >> _SOFTENING


def _random_bits(seed: int, count: int, bits: int) -> Integers:
    """Whole numbers from 0 to 2^bits - 1, (count,), by the generator SplitMix64."""
    state = np.arange(1, count + 1, dtype=np.uint64) + np.uint64(seed << 32)
    state *= np.uint64(0x9E3779B97F4A7C15)
    state ^= state >> np.uint64(30)
    state *= np.uint64(0xBF58476D1CE4E5B9)
    state ^= state >> np.uint64(27)
    state *= np.uint64(0x94D049BB133111EB)
    state ^= state >> np.uint64(31)
    return (state >> np.uint64(64 - bits)).astype(np.int64)
