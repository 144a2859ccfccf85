"""FLAC of 24 bits: as WAV, in half the bytes."""

import io
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from skinsource.errors import InvalidInputError
from skinsource.job import stop_if
from skinsource.stimulus_formats.stimulus_format import Facts, Outgoing, StimulusFormat

_BLOCK = 2**16
#: Of libsndfile.
_MOST_RATE_HZ = 655_350


def write_flac(outgoing: Outgoing, path: Path) -> Facts:
    """Write the file."""
    # Imported here: it takes as long as all the rest of the library.
    import soundfile  # noqa: PLC0415

    rate_hz = round(outgoing.stimulus.sample_rate_hz)
    if rate_hz > _MOST_RATE_HZ:
        raise InvalidInputError(
            f"FLAC knows no rate of {rate_hz} Hz, expected at most {_MOST_RATE_HZ} Hz. Choose a "
            "lower one, or WAV."
        )
    found, facts = outgoing.whole_numbers("int24")
    n_channels, n_times = found.values.shape
    # In memory: what a full disk says reaches nobody through the library's own files.
    held = io.BytesIO()
    with soundfile.SoundFile(held, "w", rate_hz, n_channels, "PCM_24", format="FLAC") as file:
        for start in range(0, n_times, _BLOCK):
            stop_if(outgoing.stop)
            part = found.values[:, start : start + _BLOCK].T
            file.write(np.ascontiguousarray(part.astype(np.int32) << 8))
            outgoing.progress(min(start + _BLOCK, n_times), n_times, "Writing")
    path.write_bytes(held.getbuffer())
    return facts


def _bytes_of(n_channels: int, n_times: int, _: Mapping[str, str]) -> int:
    return 200 + 3 * n_channels * n_times


FLAC = StimulusFormat(
    name="flac",
    title="FLAC, 24 bit",
    suffix=".flac",
    hint="As WAV of 24 bits, packed without loss; up to 8 channels",
    write=write_flac,
    bytes_of=_bytes_of,
    rounds=lambda _: True,
    most_channels=8,
)
