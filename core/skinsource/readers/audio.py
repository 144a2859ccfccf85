"""Sound files, through libsndfile: WAV, FLAC, AIFF and OGG."""

import struct
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.readers import limits
from skinsource.readers.reader import (
    Block,
    Found,
    Series,
    check_rate,
    reading_error,
    unknown_series_error,
)

# Samples of these subtypes do not fit into float32.
_WIDE = ("PCM_32", "DOUBLE", "ALAC_32")
_FORMATS = {"WAV": "WAV", "WAVEX": "WAV", "RF64": "WAV", "W64": "WAV", "FLAC": "FLAC",
            "AIFF": "AIFF", "OGG": "OGG"}  # fmt: skip
_ADVICE = "The file is damaged or incomplete; record or export it again."


def look(path: Path) -> Found:
    """Return the channels of a sound file."""
    with _opened(path) as sound:
        frames, channels, rate_hz = _checked(path, sound)
        dtype = sound.subtype.lower().replace("pcm_s8", "int8").replace("pcm_u8", "uint8")
        series = tuple(
            Series(
                key=str(k),
                name="the signal" if channels == 1 else f"channel {k + 1}",
                n_samples=frames,
                dtype=dtype.replace("pcm_", "int"),
                shape=(frames, channels),
            )
            for k in range(channels)
        )
        return Found(
            format=_FORMATS[sound.format],
            series=series,
            rate_hz=rate_hz,
            rate_from="the header",
            notes=_notes(path, frames),
        )


def blocks(path: Path, keys: Sequence[str], start: int, stop: int) -> Iterator[Block]:
    """Give samples of some channels; integers as shares of full scale."""
    with _opened(path) as sound:
        frames, channels, _ = _checked(path, sound)
        for key in keys:
            if not (key.isdecimal() and int(key) < channels):
                raise unknown_series_error(path, key)
        chosen = [int(key) for key in keys]
        kind: Any = "float64" if sound.subtype in _WIDE else "float32"
        sound.seek(min(start, frames))
        left = min(stop, frames) - start
        step = max(limits.BLOCK // channels, 1)
        while left > 0:
            part = sound.read(min(step, left), dtype=kind, always_2d=True)
            if not len(part):
                raise reading_error(path, "it ends too early", f"{frames} samples", _ADVICE)
            left -= len(part)
            yield np.ascontiguousarray(part[:, chosen].T)


def _opened(path: Path) -> Any:
    import soundfile  # noqa: PLC0415  10 ms, which only readers of sound files wait for

    return soundfile.SoundFile(str(path))


def _checked(path: Path, sound: Any) -> tuple[int, int, float]:
    if sound.format not in _FORMATS:
        raise reading_error(
            path, f"it is {sound.format}", "WAV, FLAC, AIFF or OGG", "Save it as WAV first."
        )
    rate_hz = check_rate(path, sound.samplerate)
    if not 1 <= sound.channels <= limits.MOST_CHANNELS:
        raise reading_error(
            path, f"it has {sound.channels} channels", f"1 to {limits.MOST_CHANNELS}", _ADVICE
        )
    frames = int(sound.frames)
    # Packed sound takes a few bits at least; libsndfile believes the header of some files.
    if not 1 <= frames <= max(path.stat().st_size, 1) * 4096:
        raise reading_error(
            path, f"it has {frames} samples", "at least one that is in the file", _ADVICE
        )
    return frames, sound.channels, rate_hz


def _notes(path: Path, frames: int) -> tuple[str, ...]:
    """Return a note if the header of a WAV file promises more than the file holds."""
    with path.open("rb") as file:
        size = path.stat().st_size
        riff = file.read(12)
        if riff[:4] != b"RIFF" or riff[8:] != b"WAVE":
            return ()
        position = 12
        while len(head := file.read(8)) == 8:
            name, length = head[:4], struct.unpack("<I", head[4:])[0]
            position += 8
            if name == b"data":
                # Recorders that do not know the end write 0xFFFFFFFF.
                cut = length not in (0, 0xFFFFFFFF) and position + length > size
                return (
                    (f"The file is cut off: its header promises {length} bytes of sound, "
                     f"{size - position} are there, which is {frames} samples.",)
                    if cut
                    else ()
                )  # fmt: skip
            position += length + length % 2
            file.seek(position)
    return ()
