"""Levels over the loudest 100 ms: what of a tone they do not depend on, at every place and output.

The limb passes frequencies on unequally: within 20 Hz of 100 Hz a far output may lose 25 dB. What
the ramps of a tone spread beside its frequency can so be more, far away, than the tone itself.
Ramps that stay as they are make a level that stays as it is. The ramps of a Tukey window are an
eighth of the tone: with its length the stimulus itself changes, and far away so does the level.
"""

from collections.abc import Callable, Iterator

import numpy as np

from skinsource import Limb, predict, project_axes, rms, sinusoid

FREQUENCIES_HZ = (100.0, 250.0, 600.0)
LENGTHS_S = (0.2, 0.5, 3.0)
PLACES = range(1, 21)
RAMP_S = 0.025
METHODS = {"magnitude": ("xyz", "mag"), "z": ("z", "mag"), "axis": ("xyz", "pca")}


def tapered(frequency_hz: float, duration_s: float) -> np.ndarray:
    return sinusoid(frequency_hz, duration_s, window_name="tukey")


def ramped(frequency_hz: float, duration_s: float) -> np.ndarray:
    tone = sinusoid(frequency_hz, duration_s)
    from_start = (np.arange(tone.size) + 0.5) / 1300.0
    nearest_end = np.minimum(from_start, from_start[::-1])
    return tone * np.sin(0.5 * np.pi * np.minimum(nearest_end / RAMP_S, 1.0)) ** 2


def levels_db(limb: Limb, place: int, drives: list[np.ndarray]) -> dict[str, np.ndarray]:
    """Loudest levels by each method, (n_drives, n_outputs)."""
    levels = {how: np.empty((len(drives), limb.n_outputs)) for how in METHODS}
    for k, drive in enumerate(drives):
        moved = predict(limb, drive[None], [place], [1.0], "relative")
        for how, (axes, method) in METHODS.items():
            levels[how][k] = 20.0 * np.log10(rms(project_axes(moved, axes, method), "loudest"))
    return levels


def changes(levels: np.ndarray, down_to_db: float) -> float:
    """Largest change of any output that is heard so well; of how many is for the caller to ask."""
    audible = levels[-1] >= levels[-1].max() - down_to_db
    return float(np.ptp(levels[:, audible], axis=0).max())


def of_lengths(
    limb: Limb, tone: Callable[[float, float], np.ndarray]
) -> Iterator[dict[str, np.ndarray]]:
    for frequency_hz in FREQUENCIES_HZ:
        drives = [tone(frequency_hz, length_s) for length_s in LENGTHS_S]
        for place in PLACES:
            yield levels_db(limb, place, drives)


def test_no_level_changes_with_the_onset(limb, noted):
    for frequency_hz in FREQUENCIES_HZ:
        tone = tapered(frequency_hz, 0.2)
        later = [np.concatenate((np.zeros(n), tone)) for n in (0, 77, 1300)]
        for place in PLACES:
            levels = levels_db(limb, place, later)
            for how in ("magnitude", "z"):
                noted("i onset", changes(levels[how], np.inf))
            noted("i onset axis", changes(levels["axis"], 60.0))


def test_no_level_changes_with_the_length_of_a_tone_whose_ramps_stay(limb, noted):
    for levels in of_lengths(limb, ramped):
        for how in ("magnitude", "z"):
            noted("i length", changes(levels[how], 60.0))
        noted("i length axis", changes(levels["axis"], 40.0))


def test_levels_change_little_with_the_length_of_a_tone_whose_ramps_grow(limb, noted):
    for levels_by_method in of_lengths(limb, tapered):
        for levels in levels_by_method.values():
            noted("i tapered", changes(levels, 5.0))
            noted("i tapered far", changes(levels, 20.0))
