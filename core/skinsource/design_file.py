"""`.skinsource` files: a design, the view on it and the window's arrangement, in HDF5.

Layout of version 1 (all numbers float64 or int64, all texts UTF-8 of fixed length)::

    /            format = "skinsource design", version = 1
    /design      limb, scaling
    /design/inputs/0000 …    location, amplitude, onset_s, muted, solo, colour
    /design/inputs/0000/waveform    kind, and the fields of that kind
    /view        what is looked at; an absent field is None
    /layout      bytes of the window's arrangement (may be empty)

The reader refuses what it does not understand: nothing is guessed, nothing is dropped.
"""

import io
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from skinsource import hdf5
from skinsource.design import MAX_INPUTS, Design, Input
from skinsource.errors import DesignFileError, InvalidInputError, StorageError
from skinsource.fields import (
    ChoiceSpec,
    Range,
    RangeSpec,
    SwitchSpec,
    check,
    choice,
    interval,
    specs_of,
    switch,
)
from skinsource.files import write_bytes
from skinsource.limb import LIMB_NAMES
from skinsource.view import View
from skinsource.waveforms import KINDS, Waveform

if TYPE_CHECKING:
    import h5py

FORMAT = "skinsource design"
VERSION = 1
SUFFIX = ".skinsource"

#: Far above any design; a larger file is not one.
_MAX_FILE_BYTES = 64 * 2**20
_KINDS = {kind.__name__: kind for kind in KINDS}
_VIEW_FIELDS = ("axes", "method", "outputs", "selected_input", "delay_removed", "time_range_s")
#: Fields of /view that belong to panels: the panel, and the name of the field there.
_PANEL_FIELDS = {
    "map_style": ("skin", "map_style"),
    "sensors_shown": ("skin", "sensors_shown"),
    "map_range_db": ("skin", "map_range_db"),
    "traces_layout": ("traces", "layout"),
    "spectra_layout": ("spectra", "layout"),
    "log_frequency": ("spectra", "log_frequency"),
    "log_magnitude": ("spectra", "log_magnitude"),
    "frequency_range_hz": ("spectra", "frequency_range_hz"),
}
_OPTIONAL_VIEW_FIELDS = frozenset(
    {"selected_input", "map_range_db", "time_range_s", "frequency_range_hz"}
)
_STYLE = ChoiceSpec(label="", options=(("interpolated", ""), ("sensors", "")))
_LAYOUT = ChoiceSpec(label="", options=(("overlaid", ""), ("stacked", "")))
_SWITCH, _RANGE = SwitchSpec(label=""), RangeSpec(label="")
_INPUT_FIELDS = ("location", "amplitude", "onset_s", "muted", "solo", "colour")


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignFile:
    """What a file holds: the design, the view on it, and the window's arrangement."""

    design: Design
    view: View = View()
    layout: bytes = b""


@dataclass(frozen=True, slots=True, kw_only=True)
class _PanelFields:
    """Fields of panels in version 1, and what they were by default."""

    map_style: str = choice("interpolated", _STYLE)
    sensors_shown: bool = switch(True, _SWITCH)
    map_range_db: Range | None = interval(None, _RANGE)
    traces_layout: str = choice("overlaid", _LAYOUT)
    spectra_layout: str = choice("overlaid", _LAYOUT)
    log_frequency: bool = switch(False, _SWITCH)
    log_magnitude: bool = switch(True, _SWITCH)
    frequency_range_hz: Range | None = interval(None, _RANGE)

    def __post_init__(self) -> None:
        check(self)


def save_design(path: Path, content: DesignFile) -> None:
    """Write ``content`` to ``path``, whole or not at all.

    The same content gives the same bytes.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    """
    write_bytes(path, _encoded(content))


def open_design(path: Path) -> DesignFile:
    """Read a design file.

    Raises
    ------
    StorageError
        The file cannot be read.
    DesignFileError
        It is not a design file, it is damaged, or it holds something this version does not know.
    """
    try:
        if path.stat().st_size > _MAX_FILE_BYTES:
            raise DesignFileError(f"{path.name}: too large for a design; choose a {SUFFIX} file")
        image = path.read_bytes()
    except OSError as error:
        raise StorageError(
            f"{path}: cannot be read ({error.strerror or error}). Check that the file exists and "
            "that you may read it."
        ) from error
    try:
        with hdf5.File(io.BytesIO(image), "r") as file:
            return _Reader(path.name).content(file)
    except (OSError, RuntimeError, KeyError, ValueError, TypeError, OverflowError) as error:
        if isinstance(error, InvalidInputError):
            raise DesignFileError(f"{path.name}: {error}. Nothing was opened.") from error
        raise DesignFileError(
            f"{path.name}: not a SkinSource design, or damaged ({error}). Choose a {SUFFIX} file "
            "saved by SkinSource studio."
        ) from error


def _encoded(content: DesignFile) -> bytes:
    # The image is built in memory: HDF5 on a full disk may end the process.
    image = io.BytesIO()
    # From format 1.10 on, HDF5 checks sums of all that it reads: no flipped bit goes unseen.
    with hdf5.File(image, "w", libver=("v110", "v110")) as file:
        _write(file, "format", FORMAT)
        _write(file, "version", VERSION)
        design = file.create_group("design")
        _write(design, "limb", content.design.limb)
        _write(design, "scaling", content.design.scaling)
        inputs = design.create_group("inputs")
        for index, one in enumerate(content.design.inputs):
            _write_input(inputs.create_group(f"{index:04d}"), one)
        view = file.create_group("view")
        for name, value in _view_values(content).items():
            if value is not None:
                _write(view, name, value)
        # A final zero, because an empty dataset cannot carry a checksum.
        layout = np.frombuffer(content.layout + b"\0", np.uint8)
        file.create_dataset("layout", data=layout, track_times=False, fletcher32=True)
    return image.getvalue()


def _view_values(content: DesignFile) -> dict[str, Any]:
    """Fields of /view; inputs are counted from 0."""
    design, view = content.design, content.view
    panels = {name: dict(held) for name, held in view.panels}
    values = {
        name: panels.get(panel, {}).get(own, getattr(_PanelFields(), name))
        for name, (panel, own) in _PANEL_FIELDS.items()
    }
    known = [design.index_of(id) for id in view.selected_inputs if id in design.ids]
    return values | {
        "axes": view.axes,
        "method": view.method,
        "outputs": view.outputs,
        "selected_input": known[-1] if known else None,
        "delay_removed": view.delay_removed,
        "time_range_s": view.time_range_s,
    }


def _write_input(group: "h5py.Group", one: Input) -> None:
    for name in _INPUT_FIELDS:
        _write(group, name, getattr(one, name))
    waveform = group.create_group("waveform")
    _write(waveform, "kind", type(one.waveform).__name__)
    for name in specs_of(one.waveform):
        _write(waveform, name, getattr(one.waveform, name))


def _write(group: "h5py.Group", name: str, value: Any) -> None:
    if isinstance(value, str):
        # Of fixed length: HDF5 keeps texts of free length outside its checksums.
        text = value.encode()
        kind = hdf5.string_dtype("utf-8", max(1, len(text)))
        group.attrs.create(name, text, dtype=kind)
    elif isinstance(value, tuple):
        whole = all(isinstance(part, int) for part in value)
        group.attrs[name] = np.array(value, np.int64 if whole else np.float64)
    else:
        group.attrs[name] = value


class _Reader:
    """Reads the groups of one file, and knows its name for messages."""

    def __init__(self, name: str) -> None:
        self._name = name

    def content(self, file: "h5py.File") -> DesignFile:
        found = self._attribute(file, "format")
        if found != FORMAT:
            raise DesignFileError(
                f"{self._name}: format is {found!r}, expected {FORMAT!r}. Choose a {SUFFIX} file."
            )
        version = self._attribute(file, "version")
        if type(version) is not int or version != VERSION:
            raise DesignFileError(
                f"{self._name}: written in version {version} of the format, and this studio reads "
                f"version {VERSION}. Open it with a newer SkinSource studio."
            )
        self._refuse_unknown("/", set(file.attrs), {"format", "version"})
        self._refuse_unknown("/", set(file), {"design", "view", "layout"})
        design = self._design(self._member(file, "design", hdf5.Group))
        return DesignFile(
            design=design,
            view=self._view(self._member(file, "view", hdf5.Group), design),
            layout=self._layout(self._member(file, "layout", hdf5.Dataset)),
        )

    def _design(self, group: "h5py.Group") -> Design:
        values = self._attributes(group, ("limb", "scaling"))
        if values["limb"] not in LIMB_NAMES:
            raise DesignFileError(
                f"{self._name}: made for the limb {values['limb']!r}, and this studio knows "
                f"{', '.join(LIMB_NAMES)}. Open it with a newer SkinSource studio."
            )
        self._refuse_unknown("/design", set(group), {"inputs"})
        inputs = self._member(group, "inputs", hdf5.Group)
        keys = [f"{index:04d}" for index in range(min(len(inputs), MAX_INPUTS))]
        self._refuse_unknown("/design/inputs", set(inputs) | set(inputs.attrs), set(keys))
        members = (self._member(inputs, key, hdf5.Group) for key in keys)
        return Design(inputs=tuple(self._input(member) for member in members), **values)

    def _input(self, group: "h5py.Group") -> Input:
        self._refuse_unknown(group.name, set(group), {"waveform"})
        values = self._attributes(group, _INPUT_FIELDS)
        waveform = self._waveform(self._member(group, "waveform", hdf5.Group))
        return Input(waveform=waveform, **values)

    def _waveform(self, group: "h5py.Group") -> Waveform:
        kind = self._attribute(group, "kind")
        if kind not in _KINDS:
            raise DesignFileError(
                f"{self._name}: {group.name} is a {kind!r}, and this studio knows "
                f"{', '.join(_KINDS)}. Open it with a newer SkinSource studio."
            )
        self._refuse_unknown(group.name, set(group), set())
        names = tuple(specs_of(_KINDS[kind]))
        values = self._attributes(group, ("kind", *names))
        del values["kind"]
        return _KINDS[kind](**values)

    def _view(self, group: "h5py.Group", design: Design) -> View:
        self._refuse_unknown("/view", set(group), set())
        names = (*_VIEW_FIELDS, *_PANEL_FIELDS)
        values: dict[str, Any] = dict.fromkeys(("selected_input", "time_range_s"))
        values |= self._attributes(group, names, _OPTIONAL_VIEW_FIELDS)
        index = values.pop("selected_input")
        if index is not None and (type(index) is not int or not 0 <= index < 2**31):
            raise InvalidInputError(f"selected_input is {index!r}, expected None or 0, 1, 2, …")
        # Selecting one behind the last selects the last.
        last = len(design.inputs) - 1
        chosen = () if index is None or last < 0 else (design.ids[min(index, last)],)
        present = {name: values.pop(name) for name in _PANEL_FIELDS if name in values}
        looked_at, usual = _PanelFields(**present), _PanelFields()
        panels: dict[str, dict[str, Any]] = {}
        for name, (panel, own) in _PANEL_FIELDS.items():
            if getattr(looked_at, name) != getattr(usual, name):
                panels.setdefault(panel, {})[own] = getattr(looked_at, name)
        held = tuple((panel, tuple(own.items())) for panel, own in panels.items())
        return View(selected_inputs=chosen, panels=held, **values)

    def _layout(self, dataset: "h5py.Dataset") -> bytes:
        self._refuse_unknown("/layout", set(dataset.attrs), set())
        # With a checksum it is stored in this file, and not in another one.
        sound = dataset.dtype == np.uint8 and dataset.ndim == 1 and dataset.fletcher32
        if not sound or not 1 <= dataset.size <= _MAX_FILE_BYTES:
            raise DesignFileError(
                f"{self._name}: /layout is {dataset.dtype} of shape {dataset.shape}, expected "
                "bytes with a checksum. The file is damaged; go back to an earlier copy."
            )
        return bytes(dataset[()].tobytes()[:-1])

    def _attributes(
        self, group: "h5py.Group", names: tuple[str, ...], optional: frozenset[str] = frozenset()
    ) -> dict[str, Any]:
        self._refuse_unknown(group.name, set(group.attrs), set(names))
        missing = set(names) - set(group.attrs) - optional
        if missing:
            raise DesignFileError(
                f"{self._name}: {group.name} lacks {', '.join(sorted(missing))}. The file is "
                "damaged; go back to an earlier copy."
            )
        return {name: self._attribute(group, name) for name in names if name in group.attrs}

    def _attribute(self, group: "h5py.Group", name: str) -> Any:
        if name not in group.attrs:
            return None
        # A damaged text of free length can keep HDF5 busy for ever: look before reading.
        found = group.attrs.get_id(name)
        if found.shape is None or found.dtype.kind not in "biufS":
            raise DesignFileError(
                f"{self._name}: {name} of {group.name} is of type {found.dtype}, expected a "
                f"number or a text of fixed length. Choose a {SUFFIX} file saved by SkinSource "
                "studio."
            )
        return _plain(group.attrs[name])

    def _member(self, group: "h5py.Group", name: str, kind: type) -> Any:
        # A link could lead into any other file.
        is_here = isinstance(group.get(name, getlink=True), hdf5.HardLink)
        member = group[name] if is_here else None
        if not isinstance(member, kind):
            raise DesignFileError(
                f"{self._name}: {name} in {group.name} is not a {kind.__name__.lower()} of this "
                "file. The file is damaged; go back to an earlier copy."
            )
        return member

    def _refuse_unknown(self, place: str, found: set[str], known: set[str]) -> None:
        unknown = found - known
        if unknown:
            raise DesignFileError(
                f"{self._name}: {place} holds {', '.join(sorted(unknown))}, which this studio does "
                "not understand. Open it with a newer SkinSource studio."
            )


def _plain(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return tuple(value.tolist())
    number = value.item() if isinstance(value, np.generic) else value
    return number.decode() if isinstance(number, bytes) else number
