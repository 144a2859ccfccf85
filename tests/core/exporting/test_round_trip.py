"""What is exported is what is predicted: files resampled back to the rate of the engine."""

import gzip

import numpy as np
import pytest
import scipy
import soundfile

import skinsource as ss

MOST_DB = -110.0


def read_sound(path):
    return soundfile.read(path, dtype="float64")[0]


def read_csv(path):
    return np.loadtxt(path, delimiter=",", skiprows=1)[:, 1:]


def read_bids(path):
    with gzip.open(path, "rt") as file:
        return np.loadtxt(file)


def read_mat(path):
    return scipy.io.loadmat(path)["drive"]


CASES = [
    ("wav", read_sound, {"samples": "float32"}, 48_000),
    ("wav", read_sound, {"samples": "float32"}, 44_100),
    ("wav", read_sound, {"samples": "pcm24"}, 96_000),
    ("wav", read_sound, {"samples": "pcm24"}, 8000),
    ("flac", read_sound, {}, 48_000),
    ("csv", read_csv, {}, 48_000),
    ("csv", read_csv, {}, 2000),
    ("bids", read_bids, {}, 8000),
    ("mat", read_mat, {}, 192_000),
]


@pytest.mark.parametrize(("name", "read", "choices", "rate_hz"), CASES)
def test_a_file_resampled_back_is_the_predicted_drive(
    design, predicted, tmp_path, name, read, choices, rate_hz
):
    path = tmp_path / "a"
    options = ss.StimulusOptions(choices=choices)
    done = ss.export_stimulus(design, path, name, rate_hz, options=options)
    # libsndfile takes 2^23 for 1, and a full scale that is as far on both sides is one step less.
    step = 2.0**23 / (2**23 - 1) if name == "flac" or choices.get("samples") == "pcm24" else 1.0
    samples = read(path).T * step / done.gain
    back = ss.resample(samples, rate_hz, 1300)
    for row, drive in zip(back, predicted(design).values(), strict=True):
        n = drive.size
        assert row.size >= n
        assert not drive[:65].any()
        assert not drive[-65:].any()
        error = np.abs(np.fft.rfft(row[:n] - drive, 4 * n))
        expected_spectrum = np.abs(np.fft.rfft(drive, 4 * n))
        at_hz = np.fft.rfftfreq(4 * n, 1 / 1300)
        band = (at_hz >= 25.0) & (at_hz <= 600.0)
        assert 20.0 * np.log10(error[band].max() / expected_spectrum[band].max()) < MOST_DB
        power = np.sum(error[band] ** 2) / np.sum(expected_spectrum[band] ** 2)
        assert 10.0 * np.log10(power) < MOST_DB
