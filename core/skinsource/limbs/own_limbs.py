"""Imported limbs: what one holds, its file, the folder of these files, and facts by name.

A file begins with 512 bytes: the format, and the SHA-256 and length of a text.  The text is JSON:
all but the responses, and the SHA-256 of the responses to each input.  From the next multiple of
512 on come the responses, float64, little-endian, input by input.  So the responses to one input
can be read alone, and damage is noticed wherever it is.
"""

import hashlib
import json
import os
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from pathlib import Path
from typing import IO, Any

import numpy as np

from skinsource.base.arguments import integer, one_of, real_array, real_number
from skinsource.base.assets import user_folder
from skinsource.base.conventions import AXES, BAND_HZ, Axes, Band, Floats, axes_of, axes_text
from skinsource.base.errors import (
    FileFormatError,
    InvalidInputError,
    SkinSourceError,
    StorageError,
    UnknownLimbError,
    counted,
    printable,
    quoted,
)
from skinsource.base.files import is_file, make_folder, path_text, replacing, storage_errors_of
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.limbs.limb import PUBLISHED, Limb, LimbFacts, LimbMap, limb_like

MOST_INPUTS, MOST_OUTPUTS, MOST_TAPS = 256, 512, 2**20
#: Most bytes of all responses: 256 x 512 x 3 of half a second at 4 kHz take 6.3 GB.
MOST_BYTES = 8 * 10**9
MOST_VERTICES = 20_000
LEAST_RATE_HZ, MOST_RATE_HZ = 100.0, 768_000.0
NAME_RULE = "small letters, digits and '-', at most 40, a letter first"
_NAME = re.compile(r"[a-z][a-z0-9-]{0,39}")
# Names of the published and of the synthetic limbs begin so.
_RESERVED = ("measured-", "synthetic-")
_LONGEST_TITLE, _LONGEST_NOTE, _LONGEST_PLACE_NAME = 100, 2000, 80
# Coordinates beyond this are no places on a hand, in whatever unit.
_FARTHEST = 1e6


def is_free_name(name: object) -> bool:
    """Whether an own limb may be called so: `NAME_RULE`, and no limb that comes with the studio."""
    return isinstance(name, str) and bool(_NAME.fullmatch(name)) and not name.startswith(_RESERVED)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OwnLimb:
    """An imported limb without its responses; checked when it is made.

    Attributes
    ----------
    name
        What designs and commands call it, see `NAME_RULE`.
    title, note
        What the window calls it, and what users should know of it.
    n_taps, axes, sample_rate_hz, pre_trigger_delay_s, band_hz, per_unit_drive, synthetic
        As of `skinsource.Limb`.
    hand_length_mm
        Tip of the middle finger to the middle of the wrist.
    hand_length_px
        The same in the unit of the coordinates.
    outline : (n_vertices, 2)
        Closed polygon, x to the right, y up; the back of the hand, fingertips up.
    input_positions : (n_inputs, 2)
        Seen through the hand from the back.
    output_positions : (n_outputs, 2)
        NaN where an output has no place on the back.
    input_names, output_names
        One for each; empty: none has a name.
    left
        Whether it is a left hand.
    mirrored
        Whether it is shown as a right hand.
    """

    name: str
    title: str = ""
    note: str = ""
    n_taps: int
    axes: Axes
    sample_rate_hz: float
    pre_trigger_delay_s: float = 0.0
    band_hz: Band | None = None
    per_unit_drive: bool = True
    synthetic: bool = False
    hand_length_mm: float
    hand_length_px: float
    outline: Floats
    input_positions: Floats
    output_positions: Floats
    input_names: tuple[str, ...] = ()
    output_names: tuple[str, ...] = ()
    left: bool = False
    mirrored: bool = False

    def __post_init__(self) -> None:
        if not is_free_name(self.name):
            raise InvalidInputError(
                f"the name of the limb is {quoted(self.name)}, expected {NAME_RULE}, not beginning "
                f"with {' or '.join(_RESERVED)}"
            )
        self._put(title=_checked_line("title", self.title, _LONGEST_TITLE))
        self._put(note=_checked_line("note", self.note, _LONGEST_NOTE))
        one_of("axes", self.axes, AXES)
        self._put(n_taps=integer("n_taps", self.n_taps, 1, MOST_TAPS))
        for name, least, most, unit in (
            ("sample_rate_hz", LEAST_RATE_HZ, MOST_RATE_HZ, "Hz"),
            ("pre_trigger_delay_s", 0.0, 10.0, "s"),
            ("hand_length_mm", 20.0, 2000.0, "mm"),
            ("hand_length_px", 1e-3, _FARTHEST, "of the unit of the outline"),
        ):
            expected = f"a number from {least:g} to {most:g} {unit}"
            number = real_number(name, getattr(self, name), expected, least=least, most=most)
            self._put(**{name: number})
        self._put(band_hz=_checked_band(self.band_hz, self.sample_rate_hz))
        self._check_places()
        n_bytes = 8 * self.n_inputs * self.n_outputs * len(self.axes) * self.n_taps
        if n_bytes > MOST_BYTES:
            raise InvalidInputError(
                f"the responses would take {n_bytes / 1e9:.1f} GB, expected at most "
                f"{MOST_BYTES / 1e9:g}. Shorten them, or leave places out."
            )

    def _check_places(self) -> None:
        outline = _checked_points("outline", self.outline, 3, MOST_VERTICES, missing=False)
        if len(outline) > 3 and np.array_equal(outline[0], outline[-1]):
            outline = outline[:-1]
        x, y = outline.T
        extent = np.ptp(outline, axis=0).max()
        area = 0.5 * abs(float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))))
        if not area > 1e-6 * extent**2:
            raise InvalidInputError(
                "outline encloses no area, expected the corners of a polygon in their order"
            )
        self._put(
            outline=outline,
            input_positions=_checked_points(
                "input_positions", self.input_positions, 1, MOST_INPUTS
            ),
            output_positions=_checked_points(
                "output_positions", self.output_positions, 1, MOST_OUTPUTS
            ),
        )
        for what, names, n in (
            ("input_names", self.input_names, self.n_inputs),
            ("output_names", self.output_names, self.n_outputs),
        ):
            texts = tuple(_checked_line(what, name, _LONGEST_PLACE_NAME) for name in names)
            if texts and len(texts) != n:
                raise InvalidInputError(
                    f"{what} are {len(texts)}, expected {n}, one for each place"
                )
            self._put(**{what: texts})

    def _put(self, **checked: object) -> None:
        for name, value in checked.items():
            object.__setattr__(self, name, value)

    @property
    def n_inputs(self) -> int:
        """How many input places there are."""
        return len(self.input_positions)

    @property
    def n_outputs(self) -> int:
        """How many outputs there are."""
        return len(self.output_positions)

    @property
    def shape(self) -> tuple[int, int, int, int]:
        """Of the responses: (n_inputs, n_outputs, n_axes, n_taps)."""
        return self.n_inputs, self.n_outputs, len(self.axes), self.n_taps

    def map(self) -> LimbMap:
        """Return the outline and places as they are shown."""
        # About the middle of the outline, so that it stays where it is.
        both = self.outline[:, 0].min() + self.outline[:, 0].max()

        def shown(points: Floats) -> Floats:
            return np.column_stack((both - points[:, 0], points[:, 1])) if self.mirrored else points

        return LimbMap(
            outline=shown(self.outline),
            output_positions=shown(self.output_positions),
            input_positions=shown(self.input_positions),
            hand_length_px=self.hand_length_px,
            axes_shown=False,
        )


def _checked_line(what: str, text: object, longest: int) -> str:
    if not isinstance(text, str) or len(text) > longest or not (text.isprintable()):
        raise InvalidInputError(
            f"{what} is {quoted(text)}, expected one line of at most {longest} characters"
        )
    return text.strip()


def _checked_band(band_hz: object, sample_rate_hz: float) -> Band | None:
    if band_hz is None:
        return None
    band = real_array("band_hz", band_hz, "two frequencies")  # type: ignore[arg-type]
    highest = sample_rate_hz / 2.0
    if band.shape != (2,) or not 0.0 <= band[0] < band[1] <= highest:
        raise InvalidInputError(
            f"band_hz is {quoted(band_hz)}, expected a lower and a higher frequency, up to half "
            f"the sample rate, {highest:g} Hz"
        )
    return float(band[0]), float(band[1])


def _checked_points(
    what: str, points: object, fewest: int, most: int, *, missing: bool = True
) -> Floats:
    """Return checked places, (n, 2); where ``missing``, a row with NaN is no place."""
    array = np.array(real_array(what, points, "(n, 2)"))  # type: ignore[arg-type]
    if array.ndim != 2 or array.shape[1] != 2 or not fewest <= len(array) <= most:
        raise InvalidInputError(
            f"{what} has shape {array.shape}, expected (n, 2) with {fewest} to {most} rows: x, y"
        )
    unusable = ~(np.abs(array) <= _FARTHEST)
    if missing:
        array[np.isnan(array).any(axis=1)] = np.nan
        unusable = ~(np.abs(array) <= _FARTHEST) & ~np.isnan(array)
    if unusable.any():
        row, column = np.argwhere(unusable)[0]
        raise InvalidInputError(
            f"{what}, row {row + 1}: {'xy'[column]} is {array[row, column]}, expected a number of "
            f"at most {_FARTHEST:g}"
        )
    array.flags.writeable = False
    return array


_MAGIC, _BLOCK = b"skinsource limb 1\n", 512
_MOST_TEXT_BYTES = 16 * 2**20
_ADVICE = "Check that it is there, and whose it is."
#: Largest magnitude of a response, as of `skinsource.design.signal_path`.
_LARGEST = 1e30
#: Fields that the digest of a limb is made of: all that a result can depend on.
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
#: Fields that are part of the digest only where they are set: limbs without them keep theirs.
_DIGESTED_IF_SET = ("band_hz",)
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
        with storage_errors_of(path, reading=_ADVICE), path.open("rb") as file:
            text, self._text_checksum = _read_text(file, path)
            size = path.stat().st_size
        try:
            tree = json.loads(text)
            self._checksums = tuple(str(checksum) for checksum in tree.pop("sha256"))
            self.limb = _limb_of(tree)
        except InvalidInputError as error:
            raise _damaged(path, str(error)) from error
        except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
            raise _damaged(path, f"its text makes no sense ({printable(error)})") from error
        self._first_response_byte = _first_response_byte(len(text))
        expected = self._first_response_byte + self.limb.n_inputs * self._response_bytes
        if len(self._checksums) != self.limb.n_inputs or size != expected:
            raise _damaged(path, f"it has {size} bytes, expected {expected}")
        self.digest = _digest(self.limb, self._checksums)

    @property
    def _response_bytes(self) -> int:
        return 8 * self.limb.n_outputs * len(self.limb.axes) * self.limb.n_taps

    def response(self, location: int) -> Floats:
        """Return the responses to one input place, (n_outputs, n_axes, n_taps), m/s²."""
        with storage_errors_of(self.path, reading=_ADVICE), self.path.open("rb") as file:
            if _read_text(file, self.path)[1] != self._text_checksum:
                raise FileFormatError(
                    f"{path_text(self.path)}: was replaced by other data since the limb was "
                    "opened. Open the limb again."
                )
            file.seek(self._first_response_byte + (location - 1) * self._response_bytes)
            content = file.read(self._response_bytes)
        if hashlib.sha256(content).hexdigest() != self._checksums[location - 1]:
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
        ``stop`` returned true.
    """
    # The length of the text does not depend on the checksums.
    placeholder = _json(_tree(limb, ("0" * 64,) * limb.n_inputs))
    with replacing(path) as temporary, temporary.open("r+b") as file:
        file.seek(_first_response_byte(len(placeholder)))
        checksums = []
        for number, response in enumerate(_checked(limb, responses), start=1):
            stop_if(stop)
            content = np.ascontiguousarray(response, "<f8").tobytes()
            checksums.append(hashlib.sha256(content).hexdigest())
            file.write(content)
            progress(number, limb.n_inputs, "Writing the responses")
        text = _json(_tree(limb, tuple(checksums)))
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


def _read_text(file: IO[bytes], path: Path) -> tuple[bytes, str]:
    head = file.read(_BLOCK)
    if not head.startswith(_MAGIC) or len(head) < _BLOCK:
        raise _damaged(path, "it does not begin as the file of a limb")
    lines = head[len(_MAGIC) :].rstrip(b"\0").decode("ascii", "replace").split("\n")
    if len(lines) != 3 or not lines[1].isdecimal() or len(lines[1]) > 9 or lines[2]:
        raise _damaged(path, "its head makes no sense")
    expected, n_bytes = lines[0], int(lines[1])
    if n_bytes > _MOST_TEXT_BYTES:
        raise _damaged(path, f"its text has {n_bytes} bytes, expected at most {_MOST_TEXT_BYTES}")
    text = file.read(n_bytes)
    if hashlib.sha256(text).hexdigest() != expected:
        raise _damaged(path, "its text has another checksum")
    return text, expected


def _first_response_byte(text_bytes: int) -> int:
    return _BLOCK + -(-text_bytes // _BLOCK) * _BLOCK


def _json(tree: dict[str, Any]) -> bytes:
    return json.dumps(tree, sort_keys=True, allow_nan=False, separators=(",", ":")).encode("ascii")


def _tree(limb: OwnLimb, checksums: tuple[str, ...]) -> dict[str, Any]:
    tree = {name: getattr(limb, name) for name in _FIELDS}
    for name, value in tree.items():
        if isinstance(value, np.ndarray):
            tree[name] = [None if np.isnan(row).any() else row.tolist() for row in value]
    return {**tree, "sha256": list(checksums)}


def _limb_of(tree: dict[str, Any]) -> OwnLimb:
    for name in ("outline", "input_positions", "output_positions"):
        tree[name] = [(np.nan, np.nan) if row is None else row for row in tree[name]]
    for name in ("input_names", "output_names"):
        tree[name] = tuple(tree[name])
    return OwnLimb(**tree)


def _digest(limb: OwnLimb, checksums: tuple[str, ...]) -> str:
    tree = _tree(limb, checksums)
    optional = tuple(name for name in _DIGESTED_IF_SET if tree[name] is not None)
    return hashlib.sha256(_json({name: tree[name] for name in (*_DIGESTED, *optional)})).hexdigest()


def _damaged(path: Path, reason: str) -> FileFormatError:
    return FileFormatError(
        f"{path_text(path)}: the limb cannot be used: {reason.rstrip('.')}. Import the limb again."
    )


FOLDER, ENDING = "limbs", ".limb"


def own_limb_path(name: str) -> Path:
    """Return the path of an own limb, whether or not it exists."""
    return user_folder() / FOLDER / f"own-{name}{ENDING}"


def own_limb_names() -> tuple[str, ...]:
    """Return the names of the imported limbs, in alphabetical order."""
    try:
        paths = sorted((user_folder() / FOLDER).glob(f"own-*{ENDING}"))
        names = [path.name.removeprefix("own-").removesuffix(ENDING) for path in paths]
        return tuple(name for name in names if is_free_name(name) and is_file(own_limb_path(name)))
    except (OSError, StorageError):
        return ()  # of a folder that may not be searched nothing can be used either


def install_limb(
    limb: OwnLimb,
    responses: Iterable[Floats],
    *,
    progress: Progress = silent,
    stop: Stop = never,
) -> Path:
    """Keep a limb under its name, in place of one that has this name already.

    Parameters and errors are those of `skinsource.limbs.own_limbs.write_limb_file`.
    """
    path = own_limb_path(limb.name)
    make_folder(path.parent)
    write_limb_file(path, limb, responses, progress=progress, stop=stop)
    return path


def load_own_limb(name: str) -> Limb:
    """Open an own limb: its map now, its responses one input at a time when touched.

    Raises
    ------
    UnknownLimbError
        There is none of this name.
    FileFormatError, StorageError
        Its file is damaged, or cannot be read; raised by ``response_to`` too.
    """
    file = LimbFile(existing_path(name))
    limb, read = file.limb, file.response
    return limb_like(limb, name=name, map=limb.map(), read_response=read, shape=limb.shape)


def mirror_limb(
    name: str, mirrored: bool, *, progress: Progress = silent, stop: Stop = never
) -> None:
    """Show a limb the other way round, as a right hand, or as it is.

    Raises as `load_own_limb`, and `Stopped` where ``stop`` returned true: it is as it was then.
    """
    file = LimbFile(existing_path(name))
    limb = replace(file.limb, mirrored=mirrored)
    responses = map(file.response, range(1, limb.n_inputs + 1))
    write_limb_file(file.path, limb, responses, progress=progress, stop=stop)


def remove_limb(name: str) -> None:
    """Delete an own limb; raises as `load_own_limb`, but damage is no hindrance."""
    path = existing_path(name)
    with storage_errors_of(path):
        path.unlink()


def existing_path(name: str) -> Path:
    """Return the path of an own limb; raise `UnknownLimbError` where there is none."""
    if not is_free_name(name) or not is_file(own_limb_path(name)):
        raise UnknownLimbError(
            f"no own limb is called {quoted(name)}; there are "
            f"{', '.join(own_limb_names()) or 'none'}"
        )
    return own_limb_path(name)


def facts_of(name: str) -> LimbFacts:
    """Return names and sizes of a limb; of a missing or damaged one, the published sizes.

    Where none is named, all is that of the published ones.
    Quick enough for each edit: a file is read again only after it has changed.
    """
    published = PUBLISHED.get(name)
    if published is not None:
        return published
    own = _facts_and_map(name)
    if own is not None:
        return own[0]
    band_hz = None if name else BAND_HZ
    return LimbFacts(name=name, title=name, sentence="", band_hz=band_hz, known=False)


def axes_on(limb: str, axes: Axes) -> Axes:
    """Return these axes, or all of a limb that was not measured along each of them."""
    measured = facts_of(limb).axes
    try:
        return axes_of(measured, axes)
    except InvalidInputError:
        return measured


def outputs_on(limb: str, outputs: tuple[int, ...]) -> tuple[int, ...]:
    """Return those of these outputs that a limb has; if none, as many of its first ones."""
    facts = facts_of(limb)
    if not facts.known:
        return outputs
    available = tuple(number for number in outputs if number <= facts.n_outputs)
    return available or tuple(range(1, min(len(outputs), facts.n_outputs) + 1))


def drive_unit_known(name: str, digest: str = "") -> bool:
    """Whether it is known what the responses of a limb answer: the probe, whose drive is in m/s².

    Not of a limb of a lab's own that answers a drive, nor of one that is not here.

    Parameters
    ----------
    name, digest
        Of the limb, as of a design.
    """
    facts = facts_of(name)
    other = facts.own and bool(digest) and facts.digest != digest
    return not (facts.missing or facts.per_unit_drive or other)


def own_map(name: str) -> LimbMap | None:
    """Return the map of an own limb as quickly as `facts_of`; None of any other limb."""
    own = _facts_and_map(name)
    return None if own is None else own[1]


def _facts_and_map(name: str) -> tuple[LimbFacts, LimbMap] | None:
    """Return what is known of an own limb; None of any other limb, or of a damaged one."""
    if not is_free_name(name):
        return None
    path = own_limb_path(name)
    try:
        return _read_facts(name, path, _state_of(path.stat()))
    except (OSError, SkinSourceError):
        return None


def missing_limb(name: str, digest: str) -> str:
    """Return why a design of this limb cannot be computed here; "" if it can.

    Parameters
    ----------
    name, digest
        Of the limb, as of a design.  Where a measured limb is not installed is not said here.
    """
    facts = facts_of(name)
    if not facts.known:
        return (
            f"The limb {quoted(name)} of this design is not here. Import it (File > Own limbs…), "
            "or choose another one."
        )
    if facts.own and digest and facts.digest != digest:
        return (
            f"The limb {quoted(name)} here is not that of this design: it has other numbers. "
            "Import the right one, or choose this one again."
        )
    return ""


def _band_text(band_hz: Band | None) -> str:
    return "" if band_hz is None else f", measured from {band_hz[0]:g} to {band_hz[1]:g} Hz"


def _state_of(about: os.stat_result) -> tuple[int, ...]:
    """Return what differs wherever a file took the place of another.

    Its time alone does not: the clock of a file system ticks a few milliseconds apart, and copies
    keep the time of what was copied.
    """
    return about.st_mtime_ns, about.st_ctime_ns, about.st_size, about.st_ino


@lru_cache(maxsize=64)
def _read_facts(name: str, path: Path, _state: tuple[int, ...]) -> tuple[LimbFacts, LimbMap]:
    file = LimbFile(path)
    limb = file.limb
    hand = f"{'Left' if limb.left else 'Right'} hand{', shown mirrored' if limb.mirrored else ''}"
    own: dict[str, Any] = {
        field.name: getattr(limb, field.name)
        for field in fields(LimbFacts)
        if hasattr(limb, field.name)
    }
    own["name"], own["title"] = name, limb.title or name
    sentence = (
        f"{hand}, imported: {counted(limb.n_inputs, 'place')}, "
        f"{counted(limb.n_outputs, 'output')} along "
        f"{axes_text(limb.axes)}, {limb.sample_rate_hz:g} Hz{_band_text(limb.band_hz)}."
    )
    return LimbFacts(**own, sentence=sentence, own=True, digest=file.digest), limb.map()
