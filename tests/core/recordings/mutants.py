"""Damaged recordings by the thousand, and what may come of reading one.

Every mutant is either read, and then it is what its own header says, or it is one clear error.
"""

import ast
import re
import struct
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from skinsource.base.errors import SkinSourceError
from skinsource.readers import limits
from skinsource.readers.reader import Found
from skinsource.readers.reading_process import ReadingProcess
from tests.core.recordings.conftest import WRITERS

FORMATS = ("WAV", "text", "NPY", "NPZ", "MATLAB", "MATLAB 7.3", "HDF5")
EXTREMES = (0, 1, 0x7F, 0x80, 0xFF, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF)
_SENTENCE = re.compile(r"mutant\S*: .*expected.*", re.DOTALL)
_CRASHED = ("crashed", "too long", "too much memory")


@dataclass
class Tally:
    """What came of the mutants of one format."""

    outcomes: Counter = field(default_factory=Counter)
    wrong: list[str] = field(default_factory=list)


def seed_of(file_format: str, folder: Path) -> bytes:
    """A small file of that format."""
    rng = np.random.default_rng(7)
    signal = np.round(rng.uniform(-0.9, 0.9, 60) * 32768) / 32768
    name, write = WRITERS[file_format]
    path = folder / f"seed-{name}"
    write(path, signal)
    return path.read_bytes()


def mutants(seed: bytes, count: int, random_seeds: tuple[int, ...]) -> Iterator[bytes]:
    rng = np.random.default_rng(random_seeds)
    return (_mutant(seed, rng) for _ in range(count))


def _mutant(seed: bytes, rng: np.random.Generator) -> bytes:
    """``seed`` with some damage, more often near its beginning."""
    content = bytearray(seed)
    for _ in range(int(rng.integers(1, 4))):
        if not content:
            break
        reach = len(content) if rng.random() < 0.5 else min(len(content), 400)
        at = int(rng.integers(reach))
        kind = rng.integers(7)
        if kind == 0:
            content[at] ^= 1 << int(rng.integers(8))
        elif kind == 1:
            content[at] = int(rng.integers(256))
        elif kind == 2:
            del content[at:]
        elif kind == 3:
            del content[at : at + int(rng.integers(1, 20))]
        elif kind == 4:
            content[at:at] = bytes(rng.integers(0, 256, int(rng.integers(1, 20)), np.uint8))
        elif kind == 5:
            content[at : at + 4] = struct.pack("<I", EXTREMES[int(rng.integers(len(EXTREMES)))])
        else:
            end = min(at + int(rng.integers(1, 200)), len(content))
            content[at:at] = content[at:end]
    return bytes(content)


def try_each(
    kind: str,
    contents: Iterable[bytes],
    path: Path,
    misread_in: Callable[[], str],
    is_clear: Callable[[str], bool],
) -> Tally:
    """Write and read each; an error that is no SkinSourceError is raised.

    ``misread_in`` reads the file and says what was misread, empty if nothing was.
    """
    tally = Tally()
    for number, content in enumerate(contents):
        path.write_bytes(content)
        try:
            misread = misread_in()
        except SkinSourceError as error:
            message = str(error)
            lost = any(part in message for part in _CRASHED)
            tally.outcomes["process lost" if lost else "refused"] += 1
            misread = "" if is_clear(message) else f"unclear: {message}"
        else:
            tally.outcomes["read"] += 1
        if misread:
            tally.wrong.append(f"{kind} {number}: {misread}")
    return tally


def try_mutants(
    file_format: str, count: int, random_seed: int, folder: Path, process: ReadingProcess
) -> Tally:
    """Read ``count`` mutants of a recording in a format."""
    seed, path = seed_of(file_format, folder), folder / "mutant"

    def misread_in() -> str:
        recording = process.look(path)
        return _wrong(path.read_bytes(), recording, _read(path, recording, process))

    return try_each(
        file_format,
        mutants(seed, count, (random_seed, FORMATS.index(file_format))),
        path,
        misread_in,
        lambda message: bool(_SENTENCE.fullmatch(message)) and "Traceback" not in message,
    )


def _read(path: Path, recording: Found, process: ReadingProcess) -> list[np.ndarray]:
    some = recording.series[:4]
    return [process.read(path, [series.key], 0, series.n_samples)[0] for series in some]


def _wrong(content: bytes, recording: Found, read: list[np.ndarray]) -> str:
    """What was misread; empty if nothing was."""
    if len(recording.series) > limits.MOST_SERIES:
        return "too many signals"
    rate_hz = recording.rate_hz
    if rate_hz is not None and not limits.LEAST_RATE_HZ <= rate_hz <= limits.MOST_RATE_HZ:
        return f"a rate of {rate_hz}"
    for series, values in zip(recording.series, read, strict=False):
        if values.shape != (series.n_samples,) or series.n_samples not in series.shape:
            return f"{values.shape} of {series}"
    header = {"WAV": _wav_header, "NPY": _npy_header}.get(recording.format)
    return header(content, recording) if header else ""


def _wav_header(content: bytes, recording: Found) -> str:
    """Compare with the chunks as they stand in the file."""
    at, about = 12, None
    while at + 8 <= len(content):
        name, length = content[at : at + 4], struct.unpack_from("<I", content, at + 4)[0]
        if name == b"fmt " and about is None:
            about = struct.unpack_from("<HHIIHH", content, at + 8)
        if name == b"data":
            break
        at += 8 + length + length % 2
    if about is None:
        return ""  # of another format in the same wrapping, which libsndfile knows
    tag, channels, rate, _, _, bits = about
    n_series = len(recording.series)
    if (n_series, recording.rate_hz) != (channels, rate):
        return f"{n_series} channels at {recording.rate_hz}, expected {channels} at {rate}"
    if tag == 1 and bits == 16 and content[at : at + 4] == b"data":
        there = min(length, len(content) - at - 8) // (2 * channels)
        if recording.series[0].n_samples != there:
            return f"{recording.series[0].n_samples} samples, expected {there}"
    return ""


def _npy_header(content: bytes, recording: Found) -> str:
    """Compare with the header as Python reads it."""
    size = struct.unpack_from("<H", content, 8)[0]
    at = 10
    if content[6] != 1:
        size, at = struct.unpack_from("<I", content, 8)[0], 12
    header = ast.literal_eval(content[at : at + size].decode("latin-1"))
    series = recording.series[0]
    if series.shape != header["shape"] or series.dtype != str(np.dtype(header["descr"])):
        return f"{series}, expected {header}"
    return ""
