"""Files of version 1: what studios wrote before 22 November 2026.

Layout (all numbers float64 or int64, all texts UTF-8 of fixed length)::

    /            format = "skinsource design", version = 1
    /design      limb, scaling
    /design/inputs/0000 …    location, amplitude, onset_s, muted, solo, colour
    /design/inputs/0000/waveform    kind, and the fields of that kind
    /view        what was looked at; an absent field is None
    /layout      bytes of the window's arrangement and a final zero

All of it lies under checksums of HDF5, which files of its 1.10 format have; others are refused.
The names here are those of version 1 for ever: what recipes have learned since takes its default.
Ids of inputs follow their order.  An onset is read as that of the nearest sample, which was meant.
"""

import io
from dataclasses import dataclass, replace
from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np

from skinsource import fields
from skinsource.clips import Clip
from skinsource.design import MAX_INPUTS, Design, Input
from skinsource.design_file.version_2 import meant_onset_s
from skinsource.errors import FileFormatError, InvalidInputError
from skinsource.fields import (
    ChoiceSpec,
    ListSpec,
    Misfit,
    NumberSpec,
    OptionalSpec,
    Range,
    RangeSpec,
    Spec,
    SwitchSpec,
)
from skinsource.files import hdf5
from skinsource.limb import LIMB_NAMES, N_INPUTS, N_OUTPUTS
from skinsource.quoting import printable, quoted
from skinsource.view import View
from skinsource.waveforms import Impulse, Noise, Tap, Tone, Waveform

if TYPE_CHECKING:
    import h5py

_FORMAT, _VERSION = "skinsource design", 1
#: How HDF5 files begin whose metadata have checksums.
_BEGINNING = b"\x89HDF\r\n\x1a\n\x03"
#: Far above any design of that version.
_MAX_FILE_BYTES = 64 * 2**20
#: The longest attribute lists all outputs.
_MAX_ATTRIBUTE_BYTES = 1024
_INPUT_FIELDS = ("location", "amplitude", "onset_s", "muted", "solo", "colour")
_KINDS: dict[str, tuple[type[Waveform], tuple[str, ...]]] = {
    "Tone": (Tone, ("frequency_hz", "phase_rad", "duration_s", "window")),
    "Tap": (Tap, ()),
    "Impulse": (Impulse, ()),
    "Noise": (Noise, ("seed", "duration_s", "window")),
}
_NO_DESIGN = (
    "not a SkinSource design, or damaged. Choose a .skinsource file saved by SkinSource studio."
)
_DAMAGED = "The file is damaged; go back to an earlier copy."
_NEWER = "Open it with a newer SkinSource studio."
_STYLE = ChoiceSpec(label="Style", options=(("interpolated", ""), ("sensors", "")))
_LAYOUT = ChoiceSpec(label="Layout", options=(("overlaid", ""), ("stacked", "")))
_SWITCH, _RANGE = SwitchSpec(label="Switch"), RangeSpec(label="Range")
_INDEX = NumberSpec(label="Index", minimum=0, maximum=2**31 - 1, whole=True)
# What that version allowed; anything else is damage, which nothing else there may reveal.
_LIMB = ChoiceSpec(label="Limb", options=tuple((name, "") for name in LIMB_NAMES))
_LOCATION = NumberSpec(label="Location", minimum=1, maximum=N_INPUTS, whole=True)
_FREQUENCY = NumberSpec(label="Frequency", unit="Hz", minimum=1.0, maximum=649.0)
_OUTPUTS = ListSpec(
    label="Outputs",
    of=NumberSpec(label="Output", minimum=1, maximum=N_OUTPUTS, whole=True),
    most=N_OUTPUTS,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Looks:
    """Fields of /view that are no longer as they were; the others are checked by `View`."""

    selected_input: int | None = fields.field(OptionalSpec(label="Input", of=_INDEX))
    map_style: str = fields.field(_STYLE)
    sensors_shown: bool = fields.field(_SWITCH)
    map_range_db: Range | None = fields.field(_RANGE)
    traces_layout: str = fields.field(_LAYOUT)
    spectra_layout: str = fields.field(_LAYOUT)
    log_frequency: bool = fields.field(_SWITCH)
    log_magnitude: bool = fields.field(_SWITCH)
    frequency_range_hz: Range | None = fields.field(_RANGE)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def panels(self) -> Any:
        """The settings of panels that these were."""
        return (
            (
                "skin",
                (
                    ("map_range_db", self.map_range_db),
                    ("map_style", self.map_style),
                    ("sensors_shown", self.sensors_shown),
                ),
            ),
            (
                "spectra",
                (
                    ("frequency_range_hz", self.frequency_range_hz),
                    ("layout", self.spectra_layout),
                    ("log_frequency", self.log_frequency),
                    ("log_magnitude", self.log_magnitude),
                ),
            ),
            ("traces", (("layout", self.traces_layout),)),
        )


_LOOKS = tuple(fields.specs_of(_Looks))
_KEPT_LOOKS = ("axes", "method", "outputs", "delay_removed", "time_range_s")
_MAY_BE_NONE = frozenset({"selected_input", "map_range_db", "time_range_s", "frequency_range_hz"})


def check_beginning(image: bytes) -> None:
    """Raise `FileFormatError` where an image cannot be that of such a file."""
    if len(image) > _MAX_FILE_BYTES or not image.startswith(_BEGINNING):
        raise FileFormatError(_NO_DESIGN)


def content_of(image: bytes) -> tuple[Design, View, bytes]:
    """Return what the file of this image holds: design, view, the window's arrangement.

    Raises
    ------
    FileFormatError
        It is no such file, or damaged.
    """
    check_beginning(image)
    try:
        with hdf5.File(io.BytesIO(image), "r") as file:
            return _content(file, len(image))
    except InvalidInputError as error:
        raise FileFormatError(f"{str(error).rstrip('.')}. {_DAMAGED}") from error
    except (OSError, RuntimeError, KeyError, ValueError, TypeError, OverflowError) as error:
        # What HDF5 says names parts of its own, and helps nobody.
        raise FileFormatError(_NO_DESIGN) from error


def _content(file: "h5py.File", size: int) -> tuple[Design, View, bytes]:
    found = _attribute(file, "format")
    if found != _FORMAT:
        raise FileFormatError(
            f"format is {quoted(found)}, expected {quoted(_FORMAT)}. Choose a .skinsource file."
        )
    version = _attribute(file, "version")
    if type(version) is not int or version != _VERSION:
        raise FileFormatError(
            f"written in version {quoted(version)} of the format, and without the checksum that "
            f"goes with it. {_DAMAGED}"
        )
    _refuse_unknown("/", set(file.attrs), {"format", "version"})
    _refuse_unknown("/", set(file), {"design", "view", "layout"})
    design = _design(_member(file, "design", hdf5.Group))
    return (
        design,
        _view(_member(file, "view", hdf5.Group), design),
        _layout(_member(file, "layout", hdf5.Dataset), size),
    )


def _design(group: "h5py.Group") -> Design:
    values = _attributes(group, ("limb", "scaling"))
    _check("Design.limb", values["limb"], _LIMB)
    _refuse_unknown("/design", set(group), {"inputs"})
    inputs = _member(group, "inputs", hdf5.Group)
    keys = [f"{index:04d}" for index in range(min(len(inputs), MAX_INPUTS))]
    _refuse_unknown("/design/inputs", set(inputs) | set(inputs.attrs), set(keys))
    members = (_member(inputs, key, hdf5.Group) for key in keys)
    return Design(inputs=tuple(_input(member) for member in members), **values)


def _input(group: "h5py.Group") -> Input:
    _refuse_unknown(group.name, set(group), {"waveform"})
    values = _attributes(group, _INPUT_FIELDS)
    _check("Input.location", values["location"], _LOCATION)
    waveform = _waveform(_member(group, "waveform", hdf5.Group))
    # What is no onset is refused by the clip, by its name.
    onset_s = values.pop("onset_s")
    clip = Clip(waveform=waveform, onset_s=onset_s)
    return Input(clips=(replace(clip, onset_s=meant_onset_s(clip.onset_s)),), **values)


def _waveform(group: "h5py.Group") -> Waveform:
    kind = _attribute(group, "kind")
    if kind not in _KINDS:
        raise FileFormatError(
            f"{group.name} is a {quoted(kind)}, expected one of {', '.join(_KINDS)}. {_DAMAGED}"
        )
    _refuse_unknown(group.name, set(group), set())
    recipe, names = _KINDS[kind]
    values = _attributes(group, ("kind", *names))
    del values["kind"]
    if "frequency_hz" in values:
        _check("Tone.frequency_hz", values["frequency_hz"], _FREQUENCY)
    return recipe(**values)


def _view(group: "h5py.Group", design: Design) -> View:
    _refuse_unknown("/view", set(group), set())
    values: dict[str, Any] = dict.fromkeys(_MAY_BE_NONE)
    values |= _attributes(group, (*_KEPT_LOOKS, *_LOOKS), _MAY_BE_NONE)
    _check("View.outputs", values["outputs"], _OUTPUTS)
    looks = _Looks(**{name: values.pop(name) for name in _LOOKS})
    # An index behind the last input selected the last one.
    last = len(design.inputs) - 1
    index = looks.selected_input
    chosen = () if index is None or last < 0 else (design.inputs[min(index, last)].id,)
    return View(selected_inputs=chosen, panels=looks.panels, **values)


def _check(name: str, value: Any, spec: Spec) -> None:
    try:
        spec.checked(value)
    except Misfit as misfit:
        raise FileFormatError(f"{name} is {quoted(value)}, expected {misfit}. {_DAMAGED}") from None


def _layout(dataset: "h5py.Dataset", size: int) -> bytes:
    _refuse_unknown("/layout", set(dataset.attrs), set())
    plist = dataset.id.get_create_plist()
    # One piece in this file with a checksum: other filters, and many pieces, may cost any amount.
    sound = dataset.dtype == np.uint8 and dataset.ndim == 1 and 1 <= dataset.size <= size
    sound = sound and dataset.chunks == dataset.shape and plist.get_external_count() == 0
    filters = [plist.get_filter(k)[0] for k in range(plist.get_nfilters())]
    if not sound or filters != [hdf5.h5z.FILTER_FLETCHER32]:
        raise FileFormatError(
            f"/layout is {dataset.dtype} of shape {dataset.shape}, expected one piece of bytes "
            f"with a checksum. {_DAMAGED}"
        )
    return bytes(dataset[()].tobytes()[:-1])


def _attributes(
    group: "h5py.Group", names: tuple[str, ...], optional: frozenset[str] = frozenset()
) -> dict[str, Any]:
    _refuse_unknown(group.name, set(group.attrs), set(names))
    missing = set(names) - set(group.attrs) - optional
    if missing:
        raise FileFormatError(f"{group.name} lacks {', '.join(sorted(missing))}. {_DAMAGED}")
    return {name: _attribute(group, name) for name in names if name in group.attrs}


def _attribute(group: "h5py.Group", name: str) -> Any:
    if name not in group.attrs:
        return None
    # A damaged text of free length can keep HDF5 busy for ever: look before reading.
    found = group.attrs.get_id(name)
    sound = found.shape is not None and found.dtype.kind in "biufS"
    if not sound or prod(found.shape) * found.dtype.itemsize > _MAX_ATTRIBUTE_BYTES:
        raise FileFormatError(
            f"{name} of {group.name} is of type {printable(found.dtype)} and shape {found.shape}, "
            f"expected a number or a short text of fixed length. {_DAMAGED}"
        )
    return _plain(group.attrs[name])


def _member(group: "h5py.Group", name: str, kind: type) -> Any:
    member = hdf5.own_member(group, name, kind)
    if member is None:
        raise FileFormatError(
            f"{name} in {group.name} is not a {kind.__name__.lower()} of this file. {_DAMAGED}"
        )
    return member


def _refuse_unknown(place: str, found: set[str], known: set[str]) -> None:
    unknown = sorted(found - known)
    if unknown:
        raise FileFormatError(
            f"{place} holds {printable(', '.join(unknown[:10]))}, which this studio does not "
            f"understand. {_NEWER}"
        )


def _plain(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return tuple(value.tolist())
    number = value.item() if isinstance(value, np.generic) else value
    return number.decode() if isinstance(number, bytes) else number
