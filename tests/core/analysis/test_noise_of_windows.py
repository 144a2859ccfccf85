"""Noise in windows of a prediction, against noise that is convolved, and what is told of it."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.engine.analysis_rules import noise_rms_of_windows, windows_in_noise
from skinsource.export.tables import export_windows
from skinsource.signals.analysis.noise import predicted_noise_energy, windowed_noise_energy
from skinsource.signals.analysis.windows import Windows
from tests.core.exporting.export_bench import commented

TRAIN = ss.Design(
    limb="measured-4", inputs=(ss.track(7, ss.waveforms.WaveletTrain()),), scaling="upstream"
)
LATE = replace(TRAIN, inputs=(ss.track(7, ss.waveforms.WaveletTrain(), onset_s=0.16),))
VIEW = ss.View(method="mag", windows_cut="length", window_s=0.12)
NAMES = ("rms_of_windows", "noise_rms_of_windows", "noisy_outputs_of_windows", "windows_in_noise")


def test_the_noise_of_windows_is_that_of_convolving_noise():
    rng = np.random.default_rng(31)
    drives = {3: rng.normal(size=50), 8: np.pad(rng.normal(size=20), (30, 0))}
    noise = {3: np.array([[0.1, 0.2]]), 8: np.array([[0.3, 0.05]])}
    windows = Windows(first_sample=7, window_samples=20, count=5)
    energy = np.zeros((5, 1, 2))
    for _ in range(3000):
        total = sum(
            np.stack([np.convolve(played, noise_taps) for noise_taps in rng.normal(size=(2, 60))])
            * noise[place].T
            for place, played in drives.items()
        )
        pieces = total[:, 7:107].reshape(2, 5, 20)
        energy[:, 0] += np.sum(pieces**2, axis=-1).T / 3000
    energies = windowed_noise_energy(drives, noise, 60, windows)
    assert energies == pytest.approx(energy, rel=0.06)


def test_windows_over_all_hold_all_of_the_noise():
    drive = np.random.default_rng(32).normal(size=40)
    noise = {3: np.array([[0.1, 0.2, 0.3]])}
    whole = Windows(first_sample=0, window_samples=40 + 59, count=1)
    energies = windowed_noise_energy({3: drive}, noise, 60, whole)
    assert energies[0] == pytest.approx(predicted_noise_energy({3: drive @ drive}, noise, 60))
    after = Windows(first_sample=99, window_samples=10, count=2)
    assert windowed_noise_energy({3: drive}, noise, 60, after) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("scaling", ["upstream", "relative", "probe"])
def test_windows_before_and_after_the_wave_are_noise_and_those_with_it_are_not(measured, scaling):
    for design, expected in ((TRAIN, [False] * 5), (LATE, [True, *[False] * 5, True])):
        values = ss.evaluate(replace(design, scaling=scaling), *NAMES, view=VIEW)
        assert list(values["windows_in_noise"]) == expected
    # At the elbow there is nothing but noise: predicted, and found.
    last, its_noise = values["rms_of_windows"][-1, 66:], values["noise_rms_of_windows"][-1, 66:]
    assert 0.5 < np.median(last / its_noise) < 2.0
    assert set(range(67, 73)) <= set(values["noisy_outputs_of_windows"][3])
    assert values["noisy_outputs_of_windows"][0] == tuple(range(1, 73))
    assert 29 not in values["noisy_outputs_of_windows"][3]


def test_the_noise_of_a_snapshot_that_is_matched_is_as_much_louder(measured):
    names = ("place_drives", "limb_data", "projection", "windows")
    given = ss.evaluate(LATE, *names, view=VIEW)
    once, thrice = (
        noise_rms_of_windows(**given, scaling=LATE.scaling, actuation=None, match_gain=gain)
        for gain in (1.0, 3.0)
    )
    assert thrice == pytest.approx(3.0 * once)


def test_outputs_without_a_place_on_the_map_do_not_make_a_window_more_than_noise():
    limb = ss.load_limb("synthetic-1")
    noise, rms = np.full((2, 72), 0.1), np.full((2, 72), 0.1)
    rms[0, 60:66] = 5.0
    rms[1, 30] = 5.0
    assert windows_in_noise(rms, noise, limb) == (True, False)
    assert windows_in_noise(rms, None, limb) == (False, False)


def test_a_synthetic_limb_and_silence_have_no_noise_in_windows():
    silent = replace(TRAIN, limb="synthetic-4", inputs=(replace(TRAIN.inputs[0], muted=True),))
    for design in (replace(TRAIN, limb="synthetic-4"), silent):
        values = ss.evaluate(design, *NAMES, view=VIEW)
        assert values["noise_rms_of_windows"] is None
        assert not any(values["windows_in_noise"])
        assert not any(values["noisy_outputs_of_windows"])


def test_the_table_of_windows_says_which_are_noise(measured, tmp_path):
    export_windows(tmp_path / "late.csv", LATE, VIEW)
    about, _, rows = commented(tmp_path / "late.csv")
    assert (
        "validity, windows: CAUTION: windows 1 and 7: mostly noise, and so is the extent" in about
    )
    assert len(rows) == 7
    export_windows(tmp_path / "train.csv", TRAIN, VIEW)
    assert "validity, windows" not in (tmp_path / "train.csv").read_text("utf-8")
