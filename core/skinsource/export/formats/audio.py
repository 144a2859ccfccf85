"""Sound files with one channel per actuator: WAV, and FLAC of 24 bits.

A WAV file names no loudspeakers: a "mask" that names them makes mixers filter channels and fold
them down.  The plain header has none, the extensible one gets the mask 0.
"""

import io
import struct
from pathlib import Path
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource.base.errors import InvalidInputError
from skinsource.export.formats.format import SAMPLES, Choices, Facts, StimulusFile, StimulusFormat
from skinsource.specs.spec import ChoiceSpec
from skinsource.version import __version__

_PCM, _FLOAT, _EXTENSIBLE = 1, 3, 0xFFFE
#: Bytes of a sample, and the kind of whole numbers; "": floating point.
_KINDS = {"float32": (4, ""), "pcm24": (3, "int24"), "pcm16": (2, "int16")}
_MOST_BYTES = 2**32 - 2**12
#: Rest of the identifier of a kind of samples in the extensible form.
_GUID_END = bytes.fromhex("000000001000800000aa00389b71")
_BLOCK = 2**16


class Wav(StimulusFormat):
    """WAV: floating point, or whole numbers."""

    name = "wav"
    title = "WAV"
    suffix = ".wav"
    hint = "For sound cards; one channel per actuator, no speaker layout"
    choices: ClassVar = {
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
            label="WAV header",
            options=(("plain", "Standard"), ("extensible", "Extensible, mask 0")),
            hint="Some programs want the extensible form above 2 channels",
        ),
    }

    def write(self, file: StimulusFile, path: Path) -> Facts:
        """Write the file."""
        sample_bytes, integer_kind = _KINDS[file.choices[SAMPLES]]
        n_channels, n_times = file.stimulus.samples.shape
        n_bytes = n_channels * n_times * sample_bytes
        if n_bytes > _MOST_BYTES or n_channels * sample_bytes > 0xFFFF:
            raise InvalidInputError(
                f"{n_times} samples in {n_channels} channels do not fit into a WAV file, expected "
                "at most 4 GB. Take a part of the time, or the format hdf5."
            )
        facts: Facts = {"samples": "float32"}
        values: NDArray[np.generic] = file.stimulus.samples
        if integer_kind:
            quantised, facts = file.integers(integer_kind)
            values = quantised.values
        with path.open("w+b") as output:
            output.write(_head(file, sample_bytes, n_bytes))
            for times in file.blocks(_BLOCK):
                output.write(_packed(values[:, times], sample_bytes, integer_kind))
            output.write(b"\0" * (n_bytes % 2))
        return {**facts, "container": file.choices["container"]}

    def n_bytes(self, n_channels: int, n_times: int, choices: Choices) -> int:
        """Return about how many bytes it takes."""
        return 200 + n_channels * n_times * _KINDS[choices[SAMPLES]][0]

    def rounds(self, choices: Choices) -> bool:
        """Return whether whole numbers are written."""
        return choices[SAMPLES] != "float32"

    def loses(self, choices: Choices) -> str:
        """Return a sentence on what is not in the file."""
        if choices[SAMPLES] != "pcm16":
            return ""
        return "16 bits: rounding adds noise 98 dB below full scale, 93 dB with dither."


def _packed(values: NDArray[np.generic], sample_bytes: int, integer_kind: str) -> bytes:
    """Return samples as bytes: all channels of one time, then those of the next."""
    if not integer_kind:
        return values.T.astype("<f4").tobytes()
    wide = np.ascontiguousarray(values.T.astype("<i4"))
    return wide.view(np.uint8).reshape(-1, 4)[:, :sample_bytes].tobytes()


def _head(file: StimulusFile, sample_bytes: int, n_data: int) -> bytes:
    """Return all that stands before the samples."""
    n_channels = len(file.stimulus.channels)
    rate_hz, block = round(file.stimulus.sample_rate_hz), n_channels * sample_bytes
    kind = _FLOAT if sample_bytes == 4 else _PCM
    extensible = file.choices["container"] == "extensible"
    tag = _EXTENSIBLE if extensible else kind
    bits = 8 * sample_bytes
    form = struct.pack("<HHIIHH", tag, n_channels, rate_hz, rate_hz * block, block, bits)
    if extensible:
        # Size of what follows, valid bits, mask 0, and the kind as an identifier.
        form += struct.pack("<HHIH", 22, bits, 0, kind) + _GUID_END
    chunks = _chunk(b"fmt ", form)
    if kind == _FLOAT:
        chunks += _chunk(b"fact", struct.pack("<I", file.stimulus.n_times))
    texts = (
        (b"INAM", file.design.title),
        (b"ISFT", f"SkinSource studio {__version__}"),
        (b"ICMT", f"design SHA-256 {file.digest}"),
    )
    info = b"".join(_chunk(name, text.encode() + b"\0") for name, text in texts if text)
    chunks += _chunk(b"LIST", b"INFO" + info) + b"data" + struct.pack("<I", n_data)
    size = 4 + len(chunks) + n_data + n_data % 2
    return b"RIFF" + struct.pack("<I", size) + b"WAVE" + chunks


def _chunk(name: bytes, content: bytes) -> bytes:
    return name + struct.pack("<I", len(content)) + content + b"\0" * (len(content) % 2)


#: Largest rate of libsndfile.
_MOST_RATE_HZ = 655_350


class Flac(StimulusFormat):
    """FLAC: whole numbers of 24 bits."""

    name = "flac"
    title = "FLAC, 24 bit"
    suffix = ".flac"
    hint = "As WAV of 24 bits, packed without loss; up to 8 channels"
    most_channels = 8

    def write(self, file: StimulusFile, path: Path) -> Facts:
        """Write the file."""
        # Imported here: it takes as long as all the rest of the library.
        import soundfile  # noqa: PLC0415

        rate_hz = round(file.stimulus.sample_rate_hz)
        if rate_hz > _MOST_RATE_HZ:
            raise InvalidInputError(
                f"FLAC knows no rate of {rate_hz} Hz, expected at most {_MOST_RATE_HZ} Hz. Choose "
                "a lower one, or WAV."
            )
        quantised, facts = file.integers("int24")
        # In memory: the library's own files report no full disk.
        content = io.BytesIO()
        with soundfile.SoundFile(
            content, "w", rate_hz, len(quantised.values), "PCM_24", format="FLAC"
        ) as sound:
            for times in file.blocks(_BLOCK):
                part = quantised.values[:, times].T.astype(np.int32)
                sound.write(np.ascontiguousarray(part << 8))
        path.write_bytes(content.getbuffer())
        return facts

    def n_bytes(self, n_channels: int, n_times: int, choices: Choices) -> int:
        """Return about how many bytes it takes."""
        return 200 + 3 * n_channels * n_times

    def rounds(self, choices: Choices) -> bool:
        """Return whether whole numbers are written."""
        return True
