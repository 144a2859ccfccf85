"""Files of version 1: six that its code wrote open with the same bits, nothing else does."""

import json
import re
import tracemalloc
from dataclasses import fields
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from skinsource import waveforms
from skinsource.design import Design, track
from skinsource.design_file import open_design, save_design, version_1, version_1_process
from skinsource.design_file.version_1_child import answer
from skinsource.errors import DesignFileError, FileFormatError, InvalidInputError
from skinsource.quantities import new_graph, sources
from skinsource.signals import sample_count
from skinsource.view import View

FOLDER = Path(__file__).parents[1] / "references" / "designs-v1"
EXPECTED: dict[str, Any] = json.loads((FOLDER / "expected.json").read_text(encoding="utf-8"))
RENDERED = [name for name, about in EXPECTED.items() if about["output_levels_db"]]
#: Fields of views that belong to panels now.
PANELS = {
    "skin": {name: name for name in ("map_range_db", "map_style", "sensors_shown")},
    "traces": {"layout": "traces_layout"},
    "spectra": {
        "layout": "spectra_layout",
        "log_frequency": "log_frequency",
        "log_magnitude": "log_magnitude",
        "frequency_range_hz": "frequency_range_hz",
    },
}


@pytest.fixture(autouse=True)
def _read_in_this_process(monkeypatch):
    """By the same code: a hundred processes take long; `test_version_1_process` starts some."""

    def as_today(stored):
        version_1.check_beginning(stored)
        word, _, content = answer(stored).partition(b"\n")
        if word != b"found":
            kinds = {b"damaged": FileFormatError, b"refused": InvalidInputError}
            raise kinds[word](content.decode())
        return content

    monkeypatch.setattr(version_1_process, "as_today", as_today)


def value(found: Any) -> Any:
    """What JSON holds: hexadecimal texts are floats."""
    if isinstance(found, list):
        return tuple(value(part) for part in found)
    if isinstance(found, str) and re.fullmatch(r"-?0x[01]\.?[0-9a-f]*p[+-]\d+", found):
        return float.fromhex(found)
    return found


def expected_design(about: dict[str, Any]) -> Design:
    """The design, made anew."""
    inputs = []
    for known in about["inputs"]:
        own = {name: value(one) for name, one in known.items() if name not in ("kind", "waveform")}
        onset_s = sample_count(own.pop("onset_s")) / 1300.0
        recipe = {name: value(one) for name, one in known["waveform"].items() if name != "kind"}
        kind = getattr(waveforms, known["waveform"]["kind"])
        inputs.append(track(waveform=kind(**recipe), onset_s=onset_s, **own))
    return Design(limb=about["limb"], inputs=tuple(inputs), scaling=about["scaling"])


@pytest.mark.parametrize("name", EXPECTED)
def test_every_bit_of_a_design_comes_back(name):
    found = open_design(FOLDER / f"{name}.skinsource")
    expected = expected_design(EXPECTED[name]["design"])
    assert found.design == expected
    assert repr(found.design) == repr(expected)  # -0.0 and 0.0, 1 and 1.0 are different here
    assert found.layout == bytes.fromhex(EXPECTED[name]["layout"])
    assert [one.id for one in found.design.inputs] == [*range(1, len(expected.inputs) + 1)]


@pytest.mark.parametrize("name", EXPECTED)
def test_every_bit_of_a_view_comes_back_where_it_belongs_now(name):
    found, about = open_design(FOLDER / f"{name}.skinsource"), EXPECTED[name]["view"]
    for field in ("axes", "method", "outputs", "delay_removed", "time_range_s"):
        assert repr(getattr(found.view, field)) == repr(value(about[field]))
    panels = {panel: dict(held) for panel, held in found.view.panels}
    assert {panel: set(held) for panel, held in panels.items()} == {
        panel: set(names) for panel, names in PANELS.items()
    }
    for panel, names in PANELS.items():
        for field, old in names.items():
            assert repr(panels[panel][field]) == repr(value(about[old]))
    selected = about["selected_input"]
    assert found.view.selected_input == (None if selected is None else selected + 1)


@pytest.mark.parametrize("name", RENDERED)
def test_levels_are_those_of_the_design_made_anew_to_the_last_bit(name):
    found = open_design(FOLDER / f"{name}.skinsource")
    anew = expected_design(EXPECTED[name]["design"])
    levels = [
        new_graph().evaluate({"output_levels_db"}, sources(design, found.view))["output_levels_db"]
        for design in (found.design, anew)
    ]
    assert np.array_equal(*levels, equal_nan=True)
    # Other machines and newer transforms round otherwise.
    then = [float.fromhex(level) for level in EXPECTED[name]["output_levels_db"]]
    np.testing.assert_allclose(levels[0], then, rtol=0, atol=1e-9)


@pytest.mark.parametrize("name", EXPECTED)
def test_saved_again_nothing_changes(name, tmp_path):
    found = open_design(FOLDER / f"{name}.skinsource")
    save_design(tmp_path / "any", found.design, found.view, layout=found.layout)
    assert repr(open_design(tmp_path / "any")) == repr(found)


def test_the_fixtures_hold_every_field_of_version_1():
    kinds = {
        one["waveform"]["kind"] for about in EXPECTED.values() for one in about["design"]["inputs"]
    }
    assert kinds == {"Tone", "Tap", "Impulse", "Noise"}
    views = [about["view"] for about in EXPECTED.values()]
    for field in views[0]:
        if field != "kind":
            assert len({json.dumps(view[field]) for view in views}) > 1, field
    new = {field.name for field in fields(View)} - set(views[0])
    assert {"selected_inputs", "selected_clips", "playhead_s", "span", "panels"} <= new


@pytest.fixture
def saved(tmp_path) -> Path:
    path = tmp_path / "design.skinsource"
    path.write_bytes((FOLDER / "every-kind.skinsource").read_bytes())
    return path


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
    r"Design\.limb is 'measured-9'": [add("design", "limb", np.bytes_("measured-9"))],
    r"Design\.scaling is 'loud'": [add("design", "scaling", np.bytes_("loud"))],
    "/design/inputs holds note": [add("design/inputs", "note", 1)],
    "/design/inputs holds 0007": [put("design/inputs/0007", 1)],
    "/design/inputs holds 0003": [remove(INPUT)],
    "0000 lacks onset_s": [remove(INPUT, "onset_s")],
    "0000 holds id": [add(INPUT, "id", 1)],
    "0000 holds more": [put(f"{INPUT}/more", 1)],
    r"Input\.location is 21": [add(INPUT, "location", 21)],
    r"Input\.location is 7.5": [add(INPUT, "location", 7.5)],
    r"Input\.amplitude is nan": [add(INPUT, "amplitude", np.nan)],
    r"Input\.amplitude is \(1.0, 2.0\)": [add(INPUT, "amplitude", [1.0, 2.0])],
    r"Input\.muted is 1": [add(INPUT, "muted", 1)],
    r"Input\.colour is True": [add(INPUT, "colour", True)],
    "waveform is a 'Siren'": [add(TONE, "kind", np.bytes_("Siren"))],
    "waveform is a None": [remove(TONE, "kind")],
    "waveform lacks phase_rad": [remove(TONE, "phase_rad")],
    "waveform holds harmonics": [add(TONE, "harmonics", 3)],
    "waveform holds sound": [put(f"{TONE}/sound", 1)],
    r"Tone\.frequency_hz is 0.5": [add(TONE, "frequency_hz", 0.5)],
    r"Tone\.frequency_hz is 650": [add(TONE, "frequency_hz", 650.0)],
    r"Tone\.window is 'hann'": [add(TONE, "window", np.bytes_("hann"))],
    "/view lacks axes": [remove("view", "axes")],
    "/view holds span": [add("view", "span", np.bytes_("record"))],
    "/view holds inner": [put("view/inner", 1)],
    r"View\.outputs is \(1, 73\)": [add("view", "outputs", [1, 73])],
    r"View\.outputs is \(1, 1\)": [add("view", "outputs", [1, 1])],
    "selected_input is True": [add("view", "selected_input", True)],
    "map_range_db is": [add("view", "map_range_db", [1.0, 0.0])],
    r"View\.time_range_s is": [add("view", "time_range_s", [[1.0, 2.0], [3.0, 4.0]])],
    "sensors_shown is": [add("view", "sensors_shown", np.bytes_("yes"))],
    "axes of /view is of type": [add("view", "axes", "x")],
    "method of /view is of type": [add("view", "method", h5py.Empty("f8"))],
    "scaling of /design is of type": [add("design", "scaling", np.bytes_(b"x" * 5000))],
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
    assert ".." not in str(caught.value)
    assert len(str(caught.value)) < 600
    assert saved.read_bytes() == before


ROW = np.arange(1000, dtype=np.uint8)
LAYOUTS = {
    "floats": {"data": np.float64([1.0])},
    "a scalar": {"data": np.uint8(3)},
    "two rows": {"data": np.uint8([[1, 0]]), "fletcher32": True},
    "no checksum": {"data": ROW},
    "many pieces": {"data": ROW, "chunks": (1,), "fletcher32": True},
    "two pieces": {"data": ROW, "chunks": (999,), "fletcher32": True},
    "packed": {"data": ROW, "chunks": (1000,), "fletcher32": True, "compression": "gzip"},
    "shuffled": {"data": ROW, "chunks": (1000,), "fletcher32": True, "shuffle": True},
    "enormous": {"shape": (10**12,), "dtype": "u1", "chunks": (1000,), "fletcher32": True},
    "one enormous piece": {
        "shape": (2**31,),
        "dtype": "u1",
        "chunks": (2**31,),
        "fletcher32": True,
    },
}


@pytest.mark.parametrize("case", LAYOUTS)
def test_an_arrangement_that_is_not_one_checked_piece_is_refused_unread(saved, case):
    with h5py.File(saved, "r+", libver=("v110", "v110")) as file:
        del file["layout"]
        file.create_dataset("layout", **LAYOUTS[case])
    tracemalloc.start()
    try:
        with pytest.raises(DesignFileError, match="expected one piece of bytes with a checksum"):
            open_design(saved)
        assert tracemalloc.get_traced_memory()[1] < 2**22
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("name", ["view", "design", "layout", "design/inputs", INPUT, TONE])
@pytest.mark.parametrize("link", [h5py.SoftLink, h5py.ExternalLink])
def test_a_link_that_leads_elsewhere_is_not_followed(saved, tmp_path, name, link):
    other = tmp_path / "other.skinsource"
    other.write_bytes((FOLDER / "start.skinsource").read_bytes())
    with h5py.File(saved, "r+", libver=("v110", "v110")) as file:
        file.move(name, "elsewhere") if link is h5py.SoftLink else file.pop(name)
        file[name] = link("/elsewhere") if link is h5py.SoftLink else link(str(other), f"/{name}")
    with pytest.raises(DesignFileError, match=r"is not a .* of this file|holds elsewhere"):
        open_design(saved)


@pytest.mark.parametrize("version", ["earliest", "v108"])
def test_a_file_whose_metadata_have_no_checksums_is_refused(saved, tmp_path, version):
    older = tmp_path / "older.skinsource"
    with h5py.File(saved) as file, h5py.File(older, "w", libver=(version, "v110")) as copy:
        for name in ("design", "view", "layout"):
            file.copy(name, copy)
        copy.attrs["format"], copy.attrs["version"] = file.attrs["format"], 1
    with pytest.raises(DesignFileError, match="not a SkinSource design, or damaged"):
        open_design(older)


def test_a_damaged_file_is_refused_without_words_of_hdf5(saved):
    stored = bytearray(saved.read_bytes())
    place = stored.index(b"measured") if b"measured" in stored else stored.index(b"synthetic-2")
    stored[place] ^= 1
    saved.write_bytes(stored)
    with pytest.raises(DesignFileError) as caught:
        open_design(saved)
    assert str(caught.value) == (
        "design.skinsource: not a SkinSource design, or damaged. Choose a .skinsource file saved "
        "by SkinSource studio."
    )
