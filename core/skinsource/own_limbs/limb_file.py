"""The file that an imported limb is kept in.

512 bytes of head: the format, the SHA-256 and the length of the text behind them.  The text: JSON,
all but the responses, and the SHA-256 of each of them.  From the next multiple of 512 on: the
responses, float64, little-endian, input by input.  So one input is read alone, and damage is
noticed wherever it is.
"""

import hashlib
import json
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import IO, Any

import numpy as np

from skinsource.arrays import Floats
from skinsource.counting import counted
from skinsource.errors import FileFormatError, InvalidInputError, StorageError
from skinsource.files import named, replacing
from skinsource.job import Progress, Stop, never, silent, stop_if
from skinsource.own_limbs.content import OwnLimb
from skinsource.quoting import printable

_MAGIC, _BLOCK = b"skinsource limb 1\n", 512
_MOST_TEXT = 16 * 2**20
_AGAIN = "Import the limb again."
#: What the digest of a limb is made of: all that a number can depend on.
_DIGESTED = (
    "n_taps",
    "axes",
    "sample_rate_hz",
    "pre_trigger_delay_s",
    "per_unit_drive",
    "hand_length_mm",
    "hand_length_px",
    "outline",
    "input_positions",
    "output_positions",
    "sha256",
)
#: And of these, where they are said: limbs that say nothing of them keep their digest.
_DIGESTED_IF_SAID = ("band_hz",)
_FIELDS = tuple(OwnLimb.__dataclass_fields__)


class LimbFile:
    """An own limb on disk; it is opened for each reading, so that it can be replaced meanwhile.

    Attributes
    ----------
    path
        The file.
    limb
        What it holds, but for the responses.
    digest
        SHA-256 of all numbers of the limb.

    Raises
    ------
    StorageError
        The file cannot be read.
    FileFormatError
        It is damaged, or no such file.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            with path.open("rb") as file:
                text, self._text_sum = _text_of(file, path)
                size = path.stat().st_size
        except OSError as error:
            raise StorageError(
                f"{named(path)}: cannot be read ({error.strerror or error}). Check that it is "
                "there, and whose it is."
            ) from error
        try:
            tree = json.loads(text)
            self._sums = tuple(str(one) for one in tree.pop("sha256"))
            self.limb = _limb_of(tree)
        except InvalidInputError as error:
            raise _damaged(path, str(error)) from error
        except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
            raise _damaged(path, f"its text makes no sense ({printable(error)})") from error
        self._start = _start(len(text))
        expected = self._start + self.limb.n_inputs * self._bytes_each
        if len(self._sums) != self.limb.n_inputs or size != expected:
            raise _damaged(path, f"it has {size} bytes, expected {expected}")
        self.digest = _digest(self.limb, self._sums)

    @property
    def _bytes_each(self) -> int:
        return 8 * self.limb.n_outputs * len(self.limb.axes) * self.limb.n_taps

    def response(self, location: int) -> Floats:
        """Responses to one input place, (n_outputs, n_axes, n_taps), m/s²."""
        try:
            with self.path.open("rb") as file:
                if _text_of(file, self.path)[1] != self._text_sum:
                    raise FileFormatError(
                        f"{named(self.path)}: was replaced by other data since the limb was "
                        "opened. Open the limb again."
                    )
                file.seek(self._start + (location - 1) * self._bytes_each)
                content = file.read(self._bytes_each)
        except OSError as error:
            raise StorageError(
                f"{named(self.path)}: cannot be read ({error.strerror or error}). Check that it "
                "is there, and whose it is."
            ) from error
        if hashlib.sha256(content).hexdigest() != self._sums[location - 1]:
            raise _damaged(self.path, f"the responses to input {location} have another checksum")
        return np.frombuffer(content, "<f8").astype(np.float64).reshape(self.limb.shape[1:])


def write_limb_file(
    path: Path,
    limb: OwnLimb,
    responses: Iterable[Floats],
    *,
    progress: Progress = silent,
    stop: Stop = never,
) -> None:
    """Write a limb, whole or not at all.

    Parameters
    ----------
    path
        The file; what stands there is replaced.
    limb
        All but the responses.
    responses
        Those to one input place after another, (n_outputs, n_axes, n_taps) each, m/s².

    Raises
    ------
    InvalidInputError
        A response has another shape, or holds what is no usable number.
    StorageError
        The disk is full, the folder cannot be written.
    Stopped
        ``stop`` said so.
    """
    # The text is as long whatever the checksums are.
    room = _start(len(_encoded(limb, ("0" * 64,) * limb.n_inputs)))
    with replacing(path) as temporary, temporary.open("r+b") as file:
        file.seek(room)
        sums = []
        for number, response in enumerate(_checked(limb, responses), start=1):
            stop_if(stop)
            content = np.ascontiguousarray(response, "<f8").tobytes()
            sums.append(hashlib.sha256(content).hexdigest())
            file.write(content)
            progress(number, limb.n_inputs, "Writing the responses")
        text = _encoded(limb, tuple(sums))
        file.seek(0)
        head = _MAGIC + f"{hashlib.sha256(text).hexdigest()}\n{len(text)}\n".encode()
        file.write(head.ljust(_BLOCK, b"\0") + text)


def _checked(limb: OwnLimb, responses: Iterable[Floats]) -> Iterator[Floats]:
    count = 0
    for number, response in enumerate(responses, start=1):
        if response.shape != limb.shape[1:]:
            raise InvalidInputError(
                f"the response to input {number} has shape {response.shape}, expected "
                f"{limb.shape[1:]} (outputs, axes, taps)"
            )
        usable = np.abs(response) <= _LARGEST
        if not usable.all():
            output, axis, tap = np.argwhere(~usable)[0]
            raise InvalidInputError(
                f"in the response to input {number}, output {output + 1}, axis "
                f"{limb.axes[axis]}, tap {tap} is {response[output, axis, tap]}, expected a "
                f"finite number of at most {_LARGEST:g}. Mend the measurement, or leave the place "
                "out."
            )
        count = number
        yield response
    if count != limb.n_inputs:
        raise InvalidInputError(
            f"there are responses to {counted(count, 'input')}, expected {limb.n_inputs}"
        )


#: As `skinsource.chain` takes it.
_LARGEST = 1e30


def _text_of(file: IO[bytes], path: Path) -> tuple[bytes, str]:
    head = file.read(_BLOCK)
    if not head.startswith(_MAGIC) or len(head) < _BLOCK:
        raise _damaged(path, "it does not begin as the file of a limb")
    lines = head[len(_MAGIC) :].rstrip(b"\0").decode("ascii", "replace").split("\n")
    if len(lines) != 3 or not lines[1].isdecimal() or len(lines[1]) > 9 or lines[2]:
        raise _damaged(path, "its head makes no sense")
    expected, n_bytes = lines[0], int(lines[1])
    if n_bytes > _MOST_TEXT:
        raise _damaged(path, f"its text has {n_bytes} bytes, expected at most {_MOST_TEXT}")
    text = file.read(n_bytes)
    if hashlib.sha256(text).hexdigest() != expected:
        raise _damaged(path, "its text has another checksum")
    return text, expected


def _start(text_bytes: int) -> int:
    return _BLOCK + -(-text_bytes // _BLOCK) * _BLOCK


def _encoded(limb: OwnLimb, sums: tuple[str, ...]) -> bytes:
    return _json(_tree(limb, sums))


def _json(tree: dict[str, Any]) -> bytes:
    return json.dumps(tree, sort_keys=True, allow_nan=False, separators=(",", ":")).encode("ascii")


def _tree(limb: OwnLimb, sums: tuple[str, ...]) -> dict[str, Any]:
    tree = {name: getattr(limb, name) for name in _FIELDS}
    for name, value in tree.items():
        if isinstance(value, np.ndarray):
            tree[name] = [None if np.isnan(row).any() else row.tolist() for row in value]
    return {**tree, "sha256": list(sums)}


def _limb_of(tree: dict[str, Any]) -> OwnLimb:
    for name in ("outline", "input_positions", "output_positions"):
        tree[name] = [(np.nan, np.nan) if row is None else row for row in tree[name]]
    for name in ("input_names", "output_names"):
        tree[name] = tuple(tree[name])
    return OwnLimb(**tree)


def _digest(limb: OwnLimb, sums: tuple[str, ...]) -> str:
    tree = _tree(limb, sums)
    said = tuple(name for name in _DIGESTED_IF_SAID if tree[name] is not None)
    return hashlib.sha256(_json({name: tree[name] for name in (*_DIGESTED, *said)})).hexdigest()


def _damaged(path: Path, reason: str) -> FileFormatError:
    return FileFormatError(
        f"{named(path)}: the limb cannot be used: {reason.rstrip('.')}. {_AGAIN}"
    )
