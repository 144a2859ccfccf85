"""Design files: everything comes back, and nothing else is ever opened."""

import errno
import os
import re
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from skinsource import design_file
from skinsource.design import MAX_INPUTS, Design, Input
from skinsource.design_file import DesignFile, open_design, save_design
from skinsource.errors import DesignFileError, StorageError
from skinsource.fields import ChoiceSpec, specs_of
from skinsource.limb import LIMB_NAMES
from skinsource.projection import AXES, METHODS
from skinsource.response_scaling import SCALINGS
from skinsource.view import View
from skinsource.waveforms import KINDS, Noise, Tap, Tone

CONTENT = DesignFile(
    design=Design(
        limb="measured-1",
        inputs=(
            Input(location=7, waveform=Tone(frequency_hz=123.456), amplitude=-0.1, solo=True),
            Input(location=20, waveform=Noise(seed=9, window="hanning"), onset_s=0.1, colour=3),
            Input(location=1, waveform=Tap(), muted=True, colour=1),
        ),
        scaling="relative",
    ),
    view=View(
        outputs=(72, 1),
        selected_inputs=(),
        panels=(("skin", (("map_range_db", (-60.5, -10.0)),)),),
    ),
    layout=b"\0arrangement\0\xff\0",
)


def numbers(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_nan=False)


def recipes(kind: type) -> st.SearchStrategy:
    def values(spec):
        if isinstance(spec, ChoiceSpec):
            return st.sampled_from([option for option, _ in spec.options])
        if spec.whole:
            return st.integers(int(spec.minimum), int(spec.maximum))
        return numbers(spec.minimum, spec.maximum)

    return st.builds(kind, **{name: values(spec) for name, spec in specs_of(kind).items()})


INPUTS = st.builds(
    Input,
    location=st.integers(1, 20),
    waveform=st.one_of([recipes(kind) for kind in KINDS]),
    amplitude=numbers(-1000.0, 1000.0),
    onset_s=numbers(0.0, 600.0),
    muted=st.booleans(),
    solo=st.booleans(),
    colour=st.integers(0, 2**31 - 1),
)
DESIGNS = st.builds(
    Design,
    limb=st.sampled_from(LIMB_NAMES),
    inputs=st.lists(INPUTS, max_size=12).map(tuple),
    scaling=st.sampled_from(SCALINGS),
)
RANGES = st.none() | st.tuples(numbers(-1e9, 1e9), numbers(-1e9, 1e9)).filter(lambda r: r[0] < r[1])
LAYOUTS = st.sampled_from(("overlaid", "stacked"))
#: Settings of panels, by panel and field.
PANEL_FIELDS = {
    ("skin", "map_style"): st.sampled_from(("interpolated", "sensors")),
    ("skin", "sensors_shown"): st.booleans(),
    ("skin", "map_range_db"): RANGES,
    ("spectra", "frequency_range_hz"): RANGES,
    ("spectra", "layout"): LAYOUTS,
    ("spectra", "log_frequency"): st.booleans(),
    ("spectra", "log_magnitude"): st.booleans(),
    ("traces", "layout"): LAYOUTS,
}
#: What is as by default is not held.
USUAL = {None, "interpolated", "overlaid"}
USUAL_SWITCHES = {"sensors_shown": True, "log_frequency": False, "log_magnitude": True}


def as_held(values: dict) -> tuple:
    panels: dict = {}
    for (panel, name), value in values.items():
        if value not in USUAL and USUAL_SWITCHES.get(name) != value:
            panels.setdefault(panel, []).append((name, value))
    return tuple((panel, tuple(held)) for panel, held in panels.items())


VIEWS = st.builds(
    View,
    axes=st.sampled_from(AXES),
    method=st.sampled_from(METHODS),
    outputs=st.lists(st.integers(1, 72), unique=True).map(tuple),
    selected_inputs=st.just(()) | st.integers(1, 12).map(lambda one: (one,)),
    delay_removed=st.booleans(),
    time_range_s=RANGES,
    panels=st.fixed_dictionaries(PANEL_FIELDS).map(as_held),
)


@settings(
    max_examples=100,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(design=DESIGNS, view=VIEWS, layout=st.binary(max_size=300))
def test_what_was_saved_is_opened_and_saved_again_as_the_same_bytes(tmp_path, design, view, layout):
    chosen = tuple(one for one in view.selected_inputs if one in design.ids)
    view = replace(view, selected_inputs=chosen)
    content = DesignFile(design=design, view=view, layout=layout)
    first, second = tmp_path / "first.skinsource", tmp_path / "second.skinsource"
    save_design(first, content)
    found = open_design(first)
    assert found == content
    assert repr(found) == repr(content)  # -0.0 and 0.0, 1 and 1.0 are different here
    save_design(second, found)
    assert second.read_bytes() == first.read_bytes()


@pytest.fixture
def saved(tmp_path) -> Path:
    path = tmp_path / "design.skinsource"
    save_design(path, CONTENT)
    return path


def test_a_design_of_as_many_inputs_as_there_may_be_comes_back(tmp_path):
    inputs = tuple(Input(location=1 + k % 20, colour=k) for k in range(MAX_INPUTS))
    content = DesignFile(design=Design(limb="synthetic-2", inputs=inputs), layout=bytes(10**6))
    save_design(tmp_path / "large", content)
    assert open_design(tmp_path / "large") == content


def test_the_file_holds_no_text_of_free_length_for_hdf5_does_not_check_those(saved):
    def look(_, member):
        for name in member.attrs:
            assert member.attrs.get_id(name).dtype.kind in "biufS"

    with h5py.File(saved) as file:
        look("/", file)
        file.visititems(look)
        assert file.attrs["format"] == b"skinsource design"


def test_the_file_does_not_hold_when_it_was_made(saved):
    with h5py.File(saved) as file:
        assert not file["layout"].id.get_create_plist().get_obj_track_times()


def add(group: str, name: str, value):
    def change(file):
        file[group].attrs[name] = value

    return change


def put(name: str, value):
    def change(file):
        file[name] = value

    return change


def remove(name: str, attribute: str | None = None):
    def change(file):
        if attribute is None:
            del file[name]
        else:
            del file[name].attrs[attribute]

    return change


TONE, INPUT = "design/inputs/0000/waveform", "design/inputs/0000"
DAMAGE = {
    "format of / is of type": [add("/", "format", "another")],
    "format is 'another'": [add("/", "format", np.bytes_("another"))],
    "version 2 of the format": [add("/", "version", 2)],
    "version 1.5 of the format": [add("/", "version", 1.5)],
    r"version \(1,\) of the format": [add("/", "version", [1])],
    "version None": [remove("/", "version")],
    "format is None": [remove("/", "format")],
    "/ holds author": [add("/", "author", 1)],
    "/ holds extra": [put("extra", 1)],
    "/design lacks scaling": [remove("design", "scaling")],
    "/design holds gain": [add("design", "gain", 1.0)],
    "made for the limb 'measured-9'": [add("design", "limb", np.bytes_("measured-9"))],
    "scaling 'loud'": [add("design", "scaling", np.bytes_("loud"))],
    "/design/inputs holds note": [add("design/inputs", "note", 1)],
    "/design/inputs holds 0007": [put("design/inputs/0007", 1)],
    "/design/inputs holds 0001|0002": [remove(INPUT)],
    "0000 lacks onset_s": [remove(INPUT, "onset_s")],
    "0000 holds pitch": [add(INPUT, "pitch", 1)],
    "0000 holds more": [put(f"{INPUT}/more", 1)],
    "input location 21": [add(INPUT, "location", 21)],
    "input location 7.0": [add(INPUT, "location", 7.0)],
    r"Input\.amplitude is nan": [add(INPUT, "amplitude", np.nan)],
    r"Input\.amplitude is \(1.0, 2.0\)": [add(INPUT, "amplitude", [1.0, 2.0])],
    "muted and solo are 1": [add(INPUT, "muted", 1)],
    "waveform is a 'Siren'": [add(TONE, "kind", np.bytes_("Siren"))],
    "waveform is a None": [remove(TONE, "kind")],
    "waveform lacks phase_rad": [remove(TONE, "phase_rad")],
    "waveform holds harmonics": [add(TONE, "harmonics", 3)],
    "waveform holds sound": [put(f"{TONE}/sound", 1)],
    r"Tone\.frequency_hz is 650": [add(TONE, "frequency_hz", 650.0)],
    r"Tone\.window is 'hann'": [add(TONE, "window", np.bytes_("hann"))],
    "/view lacks axes": [remove("view", "axes")],
    "/view holds zoom": [add("view", "zoom", 2.0)],
    "/view holds inner": [put("view/inner", 1)],
    r"View\.outputs is": [add("view", "outputs", [1, 1])],
    "map_range_db is": [add("view", "map_range_db", [1.0, 0.0])],
    "time_range_s is": [add("view", "time_range_s", [[1.0, 2.0], [3.0, 4.0]])],
    "sensors_shown is": [add("view", "sensors_shown", np.bytes_("yes"))],
    "axes of /view is of type": [add("view", "axes", "x")],
    "method of /view is of type": [add("view", "method", h5py.Empty("f8"))],
    "/layout holds note": [add("layout", "note", 1)],
    "layout in / is not a dataset": [remove("layout")],
    "view in / is not a group": [remove("view"), put("view", 1)],
}


@pytest.mark.parametrize("message", DAMAGE)
def test_what_is_not_understood_is_refused_and_said(saved, message):
    with h5py.File(saved, "r+", libver=("v110", "v110")) as file:
        for change in DAMAGE[message]:
            change(file)
    before = saved.read_bytes()
    with pytest.raises(DesignFileError, match=message) as caught:
        open_design(saved)
    assert str(caught.value).startswith("design.skinsource: ")
    assert saved.read_bytes() == before


@pytest.mark.parametrize(
    "layout",
    [np.float64([1.0]), np.uint8(3), np.uint8([[1, 0]]), np.uint8([1, 0]), np.int64([300])],
)
def test_a_layout_that_is_no_checked_row_of_bytes_is_refused(saved, layout):
    with h5py.File(saved, "r+") as file:
        del file["layout"]
        file["layout"] = layout
    with pytest.raises(DesignFileError, match="expected bytes with a checksum"):
        open_design(saved)


def test_a_layout_that_claims_to_be_enormous_is_refused_unread(saved):
    with h5py.File(saved, "r+") as file:
        del file["layout"]
        file.create_dataset("layout", (10**12,), np.uint8, chunks=(1000,), fletcher32=True)
    with pytest.raises(DesignFileError, match=re.escape("shape (1000000000000,)")):
        open_design(saved)


@pytest.mark.parametrize("name", ["view", "design", "layout", "design/inputs", INPUT, TONE])
@pytest.mark.parametrize("link", [h5py.SoftLink, h5py.ExternalLink])
def test_a_link_that_leads_elsewhere_is_not_followed(saved, tmp_path, name, link):
    other = tmp_path / "other.skinsource"
    save_design(other, replace(CONTENT, layout=b"of the other file"))
    with h5py.File(saved, "r+") as file:
        file.move(name, "elsewhere") if link is h5py.SoftLink else file.pop(name)
        file[name] = link("/elsewhere") if link is h5py.SoftLink else link(str(other), f"/{name}")
    with pytest.raises(DesignFileError, match=r"is not a .* of this file|holds elsewhere"):
        open_design(saved)


@pytest.mark.parametrize(
    "image", [b"", b"\x89HDF\r\n\x1a\n", b"design", bytes(10_000), b"PK\x03\x04" * 500]
)
def test_what_is_no_design_file_is_refused(tmp_path, image):
    (tmp_path / "any").write_bytes(image)
    with pytest.raises(DesignFileError, match=r"not a SkinSource design, or damaged"):
        open_design(tmp_path / "any")


def test_a_file_far_too_large_is_refused_unread(tmp_path, monkeypatch):
    path = tmp_path / "film.mp4"
    with path.open("wb") as file:
        file.truncate(64 * 2**20 + 1)
    monkeypatch.setattr(Path, "read_bytes", lambda _: pytest.fail("was read"))
    with pytest.raises(DesignFileError, match="too large for a design"):
        open_design(path)


def test_a_file_that_cannot_be_read_is_explained(tmp_path):
    for path in (tmp_path / "nowhere", tmp_path):
        with pytest.raises(StorageError, match="cannot be read"):
            open_design(path)


@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EIO, errno.EACCES, errno.EROFS])
@pytest.mark.parametrize(("place", "name"), [(Path, "write_bytes"), (os, "fsync"), (os, "replace")])
def test_a_save_that_fails_keeps_the_last_file(saved, monkeypatch, place, name, code):
    def failing(*_):
        raise OSError(code, os.strerror(code))

    monkeypatch.setattr(place, name, failing)
    with pytest.raises(StorageError, match=re.escape(os.strerror(code))):
        save_design(saved, DesignFile(design=Design(limb="synthetic-1")))
    monkeypatch.undo()
    assert open_design(saved) == CONTENT
    assert list(saved.parent.iterdir()) == [saved]


def test_an_image_that_cannot_be_made_keeps_the_last_file(saved, monkeypatch):
    monkeypatch.setattr(design_file, "_write_input", lambda *_: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        save_design(saved, CONTENT)
    assert open_design(saved) == CONTENT
