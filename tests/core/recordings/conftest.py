"""What the tests of recordings share: one process that reads, and files of every format."""

from pathlib import Path

import h5py
import numpy as np
import pytest
import scipy.io
import soundfile

RATE_HZ = 2000


@pytest.fixture(scope="session")
def signal():
    """(1500,), whole numbers of 1/32768 below 1, so that every format keeps them."""
    rng = np.random.default_rng(3)
    return np.round(rng.uniform(-0.9, 0.9, 1500) * 32768) / 32768


def write_wav(path, channels, rate_hz=RATE_HZ):
    """A WAV file by SciPy, (n_channels, n)."""
    samples = (np.stack(channels, axis=1) * 32768).astype("<i2")
    scipy.io.wavfile.write(path, rate_hz, samples)


def write_hdf5(path, signal):
    with h5py.File(path, "w") as file:
        file["tap/acceleration"] = signal
        file["tap/acceleration"].attrs["units"] = "m/s^2"
        file["tap/fs"] = RATE_HZ


def write_mat_7_3(path, signal):
    """As MATLAB does it: a block for its header, columns as rows."""
    with h5py.File(path, "w", userblock_size=512) as file:
        file["acc"] = signal[np.newaxis]
        file["acc"].attrs["MATLAB_class"] = np.bytes_("double")
        file["fs"] = np.array([[float(RATE_HZ)]])
        file["who"] = np.array([[72, 105]], np.uint16).T
        file["who"].attrs["MATLAB_class"] = np.bytes_("char")
        file["#refs#/a"] = signal
    with path.open("r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\0\x02IM")


def write_csv(path, signal):
    rows = (f"{k / RATE_HZ:.4f},{value:.17g}" for k, value in enumerate(signal))
    path.write_text("time [s],acc_x [g]\n" + "\n".join(rows) + "\n")


#: By format: the name of the file, and what writes a signal of 2000 Hz to it.
WRITERS = {
    "WAV": ("a.wav", lambda path, signal: write_wav(path, [signal])),
    "FLAC": ("a.flac", lambda path, signal: soundfile.write(path, signal, RATE_HZ, "PCM_24")),
    "AIFF": ("a.aiff", lambda path, signal: soundfile.write(path, signal, RATE_HZ)),
    "NPY": ("a.npy", lambda path, signal: np.save(path, signal)),
    "NPZ": ("a.npz", lambda path, signal: np.savez_compressed(path, acc=signal, fs=RATE_HZ)),
    "MATLAB": (
        "a.mat",
        lambda path, signal: scipy.io.savemat(path, {"acc": signal, "fs": float(RATE_HZ)}),
    ),
    "MATLAB 7.3": ("b.mat", write_mat_7_3),
    "HDF5": ("a.h5", write_hdf5),
    "text": ("a.csv", write_csv),
}


@pytest.fixture(scope="session")
def files(tmp_path_factory, signal) -> dict[str, Path]:
    """A file of each format, with the same signal in it."""
    folder = tmp_path_factory.mktemp("recordings")
    paths = {}
    for file_format, (name, write) in WRITERS.items():
        paths[file_format] = folder / name
        write(folder / name, signal)
    return paths
