"""Sound files with one channel per actuator: WAV, and FLAC of 24 bits.

A WAV file names no loudspeakers: a "mask" that names them makes mixers filter channels and fold
them down.  The plain header has none, the extensible one gets the mask 0.
"""

import io
import struct
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from skinsource.base.errors import InvalidInputError
from skinsource.base.job import stop_if
from skinsource.export.exported_design import steadily_written
from skinsource.export.formats.format import SAMPLES, Facts, Outgoing, StimulusFormat
from skinsource.specs.spec import ChoiceSpec
from skinsource.version import __version__

_PCM, _FLOAT, _EXTENSIBLE = 1, 3, 0xFFFE
#: Bytes of a sample, and the kind of whole numbers; "": floating point.
_KINDS = {"float32": (4, ""), "pcm24": (3, "int24"), "pcm16": (2, "int16")}
_MOST_BYTES = 2**32 - 2**12
#: Rest of the identifier of a kind of samples in the extensible form.
_GUID_END = bytes.fromhex("000000001000800000aa00389b71")
_BLOCK = 2**16


def write_wav(outgoing: Outgoing, path: Path) -> Facts:
    """Write the file."""
    sample_bytes, integer_kind = _KINDS[outgoing.choices[SAMPLES]]
    stimulus = outgoing.stimulus
    n_channels, n_times = stimulus.samples.shape
    if n_channels * n_times * sample_bytes > _MOST_BYTES or n_channels * sample_bytes > 0xFFFF:
        raise InvalidInputError(
            f"{n_times} samples in {n_channels} channels do not fit into a WAV file, expected at "
            "most 4 GB. Take a part of the time, or the format hdf5."
        )
    facts: Facts = {"samples": "float32"}
    values: NDArray[np.generic] = stimulus.samples
    if integer_kind:
        quantised, facts = outgoing.integers(integer_kind)
        values = quantised.values
    with steadily_written(path) as file:
        _write_head(file, outgoing, sample_bytes, n_times)
        for start in range(0, n_times, _BLOCK):
            stop_if(outgoing.stop)
            file.write(_packed(values[:, start : start + _BLOCK], sample_bytes, integer_kind))
            outgoing.progress(min(start + _BLOCK, n_times), n_times, "Writing")
        if n_channels * n_times * sample_bytes % 2:
            file.write(b"\0")
    return {**facts, "container": outgoing.choices["container"]}


def _packed(values: NDArray[np.generic], sample_bytes: int, integer_kind: str) -> bytes:
    """Return samples as bytes: all channels of one time, then those of the next."""
    if not integer_kind:
        return values.T.astype("<f4").tobytes()
    wide = np.ascontiguousarray(values.T.astype("<i4"))
    return wide.view(np.uint8).reshape(-1, 4)[:, :sample_bytes].tobytes()


def _write_head(file: BinaryIO, outgoing: Outgoing, sample_bytes: int, n_times: int) -> None:
    n_channels = len(outgoing.stimulus.channels)
    rate_hz, block = round(outgoing.stimulus.sample_rate_hz), n_channels * sample_bytes
    kind = _FLOAT if sample_bytes == 4 else _PCM
    extensible = outgoing.choices["container"] == "extensible"
    form = struct.pack(
        "<HHIIHH",
        _EXTENSIBLE if extensible else kind,
        n_channels,
        rate_hz,
        rate_hz * block,
        block,
        8 * sample_bytes,
    )
    if extensible:
        # Size of what follows, valid bits, mask 0, and the kind as an identifier.
        form += struct.pack("<HHIH", 22, 8 * sample_bytes, 0, kind) + _GUID_END
    chunks = _chunk(b"fmt ", form)
    if kind == _FLOAT:
        chunks += _chunk(b"fact", struct.pack("<I", n_times))
    chunks += _chunk(b"LIST", b"INFO" + _info(outgoing))
    n_data = n_times * block
    size = 4 + len(chunks) + 8 + n_data + n_data % 2
    file.write(b"RIFF" + struct.pack("<I", size) + b"WAVE" + chunks)
    file.write(b"data" + struct.pack("<I", n_data))


def _info(outgoing: Outgoing) -> bytes:
    """Return title, name of this program, and digest of the design, as chunks."""
    texts = (
        (b"INAM", outgoing.design.title),
        (b"ISFT", f"SkinSource studio {__version__}"),
        (b"ICMT", f"design SHA-256 {outgoing.digest}"),
    )
    return b"".join(_chunk(name, text.encode() + b"\0") for name, text in texts if text)


def _chunk(name: bytes, content: bytes) -> bytes:
    return name + struct.pack("<I", len(content)) + content + b"\0" * (len(content) % 2)


WAV = StimulusFormat(
    name="wav",
    title="WAV",
    suffix=".wav",
    hint="Sound cards and players: one channel per actuator, no loudspeakers named",
    write=write_wav,
    bytes_of=lambda n_channels, n_times, choices: (
        200 + n_channels * n_times * _KINDS[choices[SAMPLES]][0]
    ),
    choices={
        SAMPLES: ChoiceSpec(
            label="Samples",
            options=(
                ("float32", "32 bit, floating point"),
                ("pcm24", "24 bit"),
                ("pcm16", "16 bit"),
            ),
            hint="Floating point keeps all; some devices read whole numbers only",
        ),
        "container": ChoiceSpec(
            label="Header",
            options=(("plain", "Plain"), ("extensible", "Extensible, mask 0")),
            hint="Plain is read everywhere; some programs want the extensible form above 2 "
            "channels",
        ),
    },
    rounds=lambda choices: choices[SAMPLES] != "float32",
    loses=lambda choices: (
        "16 bits: rounding adds noise 98 dB below full scale, 93 dB with dither."
        if choices[SAMPLES] == "pcm16"
        else ""
    ),
)


#: Largest rate of libsndfile.
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
    quantised, facts = outgoing.integers("int24")
    n_channels, n_times = quantised.values.shape
    # In memory: the library's own files report no full disk.
    content = io.BytesIO()
    with soundfile.SoundFile(content, "w", rate_hz, n_channels, "PCM_24", format="FLAC") as file:
        for start in range(0, n_times, _BLOCK):
            stop_if(outgoing.stop)
            part = quantised.values[:, start : start + _BLOCK].T
            file.write(np.ascontiguousarray(part.astype(np.int32) << 8))
            outgoing.progress(min(start + _BLOCK, n_times), n_times, "Writing")
    path.write_bytes(content.getbuffer())
    return facts


FLAC = StimulusFormat(
    name="flac",
    title="FLAC, 24 bit",
    suffix=".flac",
    hint="As WAV of 24 bits, packed without loss; up to 8 channels",
    write=write_flac,
    bytes_of=lambda n_channels, n_times, _: 200 + 3 * n_channels * n_times,
    rounds=lambda _: True,
    most_channels=8,
)
