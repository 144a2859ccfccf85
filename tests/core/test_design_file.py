"""Design files: everything comes back, and nothing else is ever opened."""

import dataclasses
import errno
import io
import os
import re
from dataclasses import dataclass, replace
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from skinsource import codec, design_file, fields
from skinsource.clips import Clip, Marker
from skinsource.codec import image
from skinsource.design import MAX_INPUTS, Design, Input, track
from skinsource.design_file import DesignFile, open_design, save_design
from skinsource.errors import DesignFileError, InvalidInputError, StorageError
from skinsource.fields import (
    SEGMENTS,
    BreakpointsSpec,
    BytesSpec,
    ChoiceSpec,
    CurveSpec,
    ListSpec,
    NumberSpec,
    OptionalSpec,
    PlainSpec,
    PointsSpec,
    RangeSpec,
    RecipeSpec,
    SamplesSpec,
    SwitchSpec,
    TextSpec,
    specs_of,
)
from skinsource.limb import LIMB_NAMES
from skinsource.samples import Samples
from skinsource.view import View
from skinsource.waveforms import KINDS, Noise, Tap, Tone

DESIGN = Design(
    limb="measured-1",
    inputs=(
        track(location=7, waveform=Tone(frequency_hz=123.456), amplitude=-0.1, solo=True, id=5),
        track(location=20, waveform=Noise(seed=9, window="hanning"), onset_s=0.1, colour=3),
        track(location=1, waveform=Tap(), muted=True, colour=1),
    ),
    scaling="relative",
    title="Größe → 触覚",
    author="Somebody",
    notes="First line\nsecond line",
    licence="CC0",
)
VIEW = View(
    outputs=(72, 1), selected_inputs=(5,), panels=(("skin", (("map_range_db", (-60.5, -10.0)),)),)
)
LAYOUT = b"\0arrangement\0\xff\0"


def numbers(spec: NumberSpec) -> st.SearchStrategy:
    if spec.whole:
        return st.integers(int(spec.minimum), int(spec.maximum))
    return st.floats(spec.minimum, spec.maximum, allow_nan=False)


def texts(spec: TextSpec) -> st.SearchStrategy:
    if spec.reader is not None:
        return st.sampled_from(["sin(2*pi*90*t)", "t < 0.1", "noise(3)·hann()", "\t1 - t "])
    characters = st.characters(exclude_categories=["Cs", "Cc", "Zl", "Zp"])
    return st.text(characters, max_size=min(spec.longest, 30))


def ranges(spec: RangeSpec) -> st.SearchStrategy:
    end = st.floats(spec.minimum, spec.maximum, allow_nan=False)
    return st.none() | st.tuples(end, end).filter(lambda ends: ends[0] < ends[1])


def signals(spec: SamplesSpec) -> st.SearchStrategy:
    held = st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=1, max_size=5)
    rates = st.floats(1e-3, 1e9)
    units = st.sampled_from(["", "m/s²"]) if spec.unit is None else st.just(spec.unit)
    return st.builds(Samples, values=held, sample_rate_hz=rates, unit=units)


def curves(spec: CurveSpec) -> st.SearchStrategy:
    points = st.tuples(numbers(spec.x), numbers(spec.y))
    return st.lists(points, max_size=5).map(lambda found: tuple(sorted(found)))


PANELS = st.dictionaries(
    st.text("abc", min_size=1, max_size=4),
    st.dictionaries(
        st.text("xyz_", min_size=1, max_size=4),
        st.none()
        | st.booleans()
        | st.integers(-9, 9)
        | st.floats(allow_nan=False, allow_infinity=False)
        | st.text("ä b", max_size=5)
        | st.tuples(st.floats(-1, 1), st.integers(0, 3)),
        max_size=3,
    ).map(lambda held: tuple(sorted(held.items()))),
    max_size=3,
).map(lambda panels: tuple(sorted(panels.items())))


def any_of(spec: RecipeSpec) -> st.SearchStrategy:
    kinds = spec.kinds()
    # Clips hold waveforms, of which one kind holds clips.
    later = [st.deferred(lambda kind=kind: recipes(kind)) for kind in kinds]
    return st.one_of(later) if kinds else st.nothing()


def most(spec: ListSpec) -> int:
    """Parts of the longest list that is tried; none of kinds of which there are none."""
    empty = isinstance(spec.of, RecipeSpec) and not spec.of.kinds()
    return 0 if empty else min(spec.most, 6)


def values(spec: fields.Spec) -> st.SearchStrategy:
    """Any value that fits."""
    return fields.made_for(
        spec,
        {
            NumberSpec: numbers,
            ChoiceSpec: lambda spec: st.sampled_from([option for option, _ in spec.options]),
            SwitchSpec: lambda _: st.booleans(),
            TextSpec: texts,
            RangeSpec: ranges,
            CurveSpec: curves,
            BytesSpec: lambda _: st.binary(max_size=300),
            PlainSpec: lambda _: PANELS,
            ListSpec: lambda spec: st.lists(
                values(spec.of),
                min_size=spec.fewest,
                max_size=most(spec),
                unique=spec.different,
            ).map(tuple),
            OptionalSpec: lambda spec: st.none() | values(spec.of),
            SamplesSpec: signals,
            PointsSpec: lambda spec: st.lists(
                st.tuples(*map(values, spec.columns)), min_size=spec.fewest, max_size=6
            ).map(lambda points: tuple(sorted(points))),
            BreakpointsSpec: lambda spec: st.lists(
                st.tuples(values(spec.x), values(spec.y), st.sampled_from(SEGMENTS)),
                min_size=1,
                max_size=6,
            ).map(lambda points: tuple(sorted(points))),
            RecipeSpec: any_of,
        },
    )(spec)


@cache
def recipes(kind: type) -> st.SearchStrategy:
    if kind is Design:
        own = {name: values(spec) for name, spec in specs_of(Design).items() if name != "inputs"}
        inputs = st.lists(recipes(Input), max_size=6, unique_by=lambda one: one.id).map(alone)
        limbs = st.sampled_from(LIMB_NAMES)
        return st.builds(Design, **{**own, "inputs": inputs, "limb": limbs})
    parts = {name: values(spec) for name, spec in specs_of(kind).items()}
    return st.fixed_dictionaries(parts).map(lambda given: made(kind, given))


def alone(inputs: list[Input]) -> tuple[Input, ...]:
    """The inputs, with clips that no other one has."""
    return tuple(
        replace(one, clips=tuple(replace(clip, id=0) for clip in one.clips)) for one in inputs
    )


def made(kind: type, given: dict):
    """A recipe; one of defaults where these values, each for itself allowed, do not go together."""
    try:
        return kind(**given)
    except InvalidInputError:
        return kind()


@settings(
    max_examples=200,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(content=recipes(DesignFile))
def test_what_was_saved_is_opened_and_saved_again_as_the_same_bytes(tmp_path, content):
    first, second = tmp_path / "first.skinsource", tmp_path / "second.skinsource"
    save_design(first, content.design, content.view, layout=content.layout)
    found = open_design(first)
    assert found == content
    assert repr(found) == repr(content)  # -0.0 and 0.0, 1 and 1.0 are different here
    save_design(second, found.design, found.view, layout=found.layout)
    assert second.read_bytes() == first.read_bytes()


@pytest.fixture
def saved(tmp_path) -> Path:
    path = tmp_path / "design.skinsource"
    save_design(path, DESIGN, VIEW, layout=LAYOUT)
    return path


def test_a_file_holds_design_view_and_arrangement(saved):
    found = open_design(saved)
    assert found == DesignFile(design=DESIGN, view=VIEW, layout=LAYOUT)
    assert [one.id for one in found.design.inputs] == [5, 1, 2]
    save_design(str(saved), DESIGN)
    assert open_design(str(saved)) == DesignFile(design=DESIGN)


def test_every_field_of_what_is_saved_describes_itself():
    for kind in (DesignFile, Design, Input, Clip, Marker, View, *KINDS):
        names = [field.name for field in dataclasses.fields(kind) if field.init]
        assert list(specs_of(kind)) == names, kind


def test_a_design_of_as_many_inputs_as_there_may_be_comes_back(tmp_path):
    inputs = tuple(track(location=1 + k % 20, colour=k) for k in range(MAX_INPUTS))
    design = Design(limb="synthetic-2", inputs=inputs)
    save_design(tmp_path / "large", design, layout=bytes(10**6))
    assert open_design(tmp_path / "large").design == design


def test_more_arrangement_than_fits_is_refused_before_anything_is_written(tmp_path):
    with pytest.raises(InvalidInputError, match="at most 1048576 bytes"):
        save_design(tmp_path / "large", DESIGN, layout=bytes(2**20 + 1))
    assert not list(tmp_path.iterdir())


def test_every_flipped_bit_is_refused(tmp_path):
    save_design(tmp_path / "small", Design(limb="synthetic-1", inputs=(track(location=1),)))
    stored = (tmp_path / "small").read_bytes()
    for bit in range(8 * len(stored)):
        damaged = bytearray(stored)
        damaged[bit // 8] ^= 1 << bit % 8
        (tmp_path / "small").write_bytes(damaged)
        with pytest.raises(DesignFileError):
            open_design(tmp_path / "small")


def test_any_other_damage_to_a_larger_file_is_refused(tmp_path):
    random = np.random.default_rng(4)
    inputs = tuple(track(location=1 + k % 20, waveform=KINDS[k % 4]()) for k in range(100))
    path = tmp_path / "large"
    save_design(path, Design(limb="synthetic-1", inputs=inputs), layout=random.bytes(5000))
    stored = path.read_bytes()
    for attempt in range(400):
        place, length = int(random.integers(len(stored))), int(random.integers(1, 64))
        other = random.bytes(length) if attempt % 2 else bytes(length)
        damaged = [
            stored[:place] + other + stored[place + length :],
            stored[:place] + other + stored[place:],
            stored[:place] + stored[place + length :],
            stored[:place],
        ][attempt % 4]
        path.write_bytes(damaged)
        if damaged != stored:
            with pytest.raises(DesignFileError):
                open_design(path)


def rewritten(path: Path, change) -> None:
    """Write what another studio would have written: another tree, with its checksum."""
    tree = codec.encode(DesignFile(design=DESIGN, view=VIEW))
    change(tree)
    path.write_bytes(image.to_image(tree, design_file.VERSION))


def clip_of(tree: dict, index: int) -> dict:
    """Tree of the clip of one of the inputs."""
    return tree["design"]["inputs"][index]["clips"][0]


OTHERS = {
    "design holds gain": lambda tree: tree["design"].update(gain=1.0),
    "view holds zoom": lambda tree: tree["view"].update(zoom=2.0),
    "the content holds scenes": lambda tree: tree.update(scenes=[]),
    "waveform holds harmonics": lambda tree: clip_of(tree, 0)["waveform"].update(harmonics=3),
    "inputs/1/clips/0 holds colour": lambda tree: clip_of(tree, 1).update(colour=3),
    "clips/0/waveform is of kind 'Siren'": lambda tree: clip_of(tree, 1).update(
        waveform={"kind": "Siren"}
    ),
    "clips/0/effects/0 is of kind 'Echo'": lambda tree: clip_of(tree, 1).update(
        effects=[{"kind": "Echo"}]
    ),
    "inputs/2 is of kind 'Track'": lambda tree: tree["design"]["inputs"][2].update(kind="Track"),
}


@pytest.mark.parametrize("message", OTHERS)
def test_what_a_newer_studio_wrote_is_refused_and_said(saved, message):
    rewritten(saved, OTHERS[message])
    before = saved.read_bytes()
    with pytest.raises(DesignFileError, match=message) as caught:
        open_design(saved)
    assert str(caught.value).startswith("design.skinsource: ")
    assert str(caught.value).endswith("Open it with a newer SkinSource studio.")
    assert saved.read_bytes() == before


def clips(**fields: Any) -> list[dict]:
    """Tree of the clips of an input: one, with these fields."""
    return [{"kind": "Clip", **fields}]


WRONG = {
    r"Tone\.frequency_hz is 0": ("clips", clips(waveform={"kind": "Tone", "frequency_hz": 0.0})),
    r"Tone\.window is 'hann'": ("clips", clips(waveform={"kind": "Tone", "window": "hann"})),
    r"Clip\.onset_s is -0.1": ("clips", clips(onset_s=-0.1)),
    r"Clip\.gain is '1'": ("clips", clips(gain="1")),
    r"Input\.clips is 'all'": ("clips", "all"),
    r"Input\.gain_curve is .*, expected": ("gain_curve", [[1.0, 0.5], [0.5, 1.0]]),
    r"ids of the clips": ("clips", 2 * clips(id=9)),
    r"Input\.location is 0": ("location", 0),
    r"Input\.location is 'nnnn.{70,80}…, expected": ("location", "n" * 10**6),
    r"Input\.muted is 1": ("muted", 1),
    r"Input\.colour is True": ("colour", True),
    r"Input\.amplitude is \[1.0, 2.0\]": ("amplitude", [1.0, 2.0]),
    r"ids of the inputs": ("id", 1),
}


@pytest.mark.parametrize("message", WRONG)
def test_a_value_that_cannot_be_is_refused_and_said(saved, message):
    name, value = WRONG[message]
    rewritten(saved, lambda tree: tree["design"]["inputs"][0].update({name: value}))
    with pytest.raises(DesignFileError, match=message) as caught:
        open_design(saved)
    assert len(str(caught.value)) < 600
    assert ".." not in str(caught.value)


def test_what_every_version_writes_may_not_be_missing(saved):
    rewritten(saved, lambda tree: tree["design"]["inputs"][0].pop("location"))
    with pytest.raises(DesignFileError, match="inputs/0 lacks location"):
        open_design(saved)


def test_a_file_of_version_4_is_refused_as_newer(saved):
    stored = saved.read_bytes().replace(b"version 3", b"version 4", 1)
    saved.write_bytes(stored)
    with pytest.raises(DesignFileError, match=r"version 4 .* Open it with a newer SkinSource"):
        open_design(saved)


@pytest.mark.parametrize(
    "stored", [b"", b"\x89HDF\r\n\x1a\n", b"design", bytes(10_000), b"PK\x03\x04" * 500]
)
def test_what_is_no_design_file_is_refused(tmp_path, stored):
    (tmp_path / "any").write_bytes(stored)
    with pytest.raises(DesignFileError, match=r"not a SkinSource design, or damaged"):
        open_design(tmp_path / "any")


def test_a_file_far_too_large_is_refused_unread(tmp_path):
    with (tmp_path / "film.mp4").open("wb") as file:
        file.truncate(2**33)
    with pytest.raises(DesignFileError, match=r"^film\.mp4: 8589934592 bytes are too large"):
        open_design(tmp_path / "film.mp4")


@pytest.mark.parametrize("name", ["nowhere", ".", "a\0b", "x" * 300])
def test_a_file_that_cannot_be_read_is_explained(tmp_path, name):
    with pytest.raises(StorageError, match="cannot be read"):
        open_design(tmp_path / name)


@pytest.mark.skipif(os.name != "posix", reason="POSIX only")
def test_a_pipe_and_an_endless_device_are_refused(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path / "pipe", Path("/dev/zero")):
        with pytest.raises(StorageError, match="no regular file"):
            open_design(path)


@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EIO, errno.EACCES, errno.EROFS])
@pytest.mark.parametrize(("place", "name"), [(Path, "write_bytes"), (os, "fsync"), (os, "replace")])
def test_a_save_that_fails_keeps_the_last_file(saved, monkeypatch, place, name, code):
    def failing(*_):
        raise OSError(code, os.strerror(code))

    monkeypatch.setattr(place, name, failing)
    with pytest.raises(StorageError, match=re.escape(os.strerror(code))):
        save_design(saved, Design(limb="synthetic-1"))
    monkeypatch.undo()
    assert open_design(saved).design == DESIGN
    assert list(saved.parent.iterdir()) == [saved]


def test_an_image_that_cannot_be_made_keeps_the_last_file(saved, monkeypatch):
    monkeypatch.setattr(image, "to_image", lambda *_: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        save_design(saved, DESIGN)
    monkeypatch.undo()
    assert open_design(saved).design == DESIGN


@dataclass(frozen=True, slots=True, kw_only=True)
class WiderView(View):
    speed: float = fields.number(0.5, NumberSpec(label="Speed", minimum=0.0))


@dataclass(frozen=True, slots=True, kw_only=True)
class RicherInput(Input):
    label: str = fields.text("", TextSpec(label="Label", longest=20))
    recorded: Samples | None = fields.field(
        fields.OptionalSpec(label="Recorded", of=SamplesSpec(label="Recorded")), default=None
    )


@pytest.fixture
def tomorrow(monkeypatch) -> dict[str, Any]:
    """A studio whose views and inputs have more fields; nothing else of it is different."""
    view = dataclasses.make_dataclass("View", [], bases=(WiderView,), frozen=True, kw_only=True)
    one = dataclasses.make_dataclass("Input", [], bases=(RicherInput,), frozen=True, kw_only=True)
    monkeypatch.setattr("skinsource.design_file.View", view)
    monkeypatch.setattr("skinsource.design.Input", one)
    return {"View": view, "Input": one}


def test_a_new_field_needs_no_other_file_touched(saved, tomorrow):
    older = open_design(saved)
    assert older.view.speed == 0.5
    assert older.view.outputs == VIEW.outputs
    assert [one.label for one in older.design.inputs] == ["", "", ""]
    assert older.design.inputs[0].amplitude == -0.1
    sound = Samples(values=np.arange(9.0), sample_rate_hz=1300.0)
    marked = [replace(one, label="left", recorded=sound) for one in older.design.inputs]
    design = replace(older.design, inputs=tuple(marked))
    save_design(saved, design, replace(older.view, speed=2.25))
    found = open_design(saved)
    assert found.view.speed == 2.25
    assert found.design == design
    assert found.design.inputs[0].recorded == sound


def test_the_studio_of_today_refuses_what_the_one_of_tomorrow_wrote(saved, tomorrow, monkeypatch):
    older = open_design(saved)
    save_design(saved, older.design, older.view)
    monkeypatch.undo()
    with pytest.raises(DesignFileError, match=r"holds .*newer SkinSource studio"):
        open_design(saved)


def test_a_studio_that_knows_version_1_only_learns_that_it_is_too_old(saved):
    with h5py.File(saved) as file:
        assert file.attrs["format"] == b"skinsource design"
        assert file.attrs["version"] == 3


def test_a_hostile_file_with_a_right_checksum_costs_nothing(saved):
    memory = io.BytesIO()
    with h5py.File(memory, "w", userblock_size=512, libver=("v110", "v110")) as file:
        file.create_dataset(
            "content", (2**34,), np.uint8, chunks=(1,), compression="gzip", fletcher32=True
        )
        file.create_group("samples")
    stored = memory.getvalue()[512:]
    words = f"SkinSource design, version 3\nSHA-256 {sha256(stored).hexdigest()}\n"
    saved.write_bytes(words.encode().ljust(512, b"\n") + stored)
    with pytest.raises(DesignFileError, match="not larger than the file"):
        open_design(saved)


def test_a_file_is_not_opened_by_what_it_is_called(tmp_path, saved):
    (tmp_path / "Handfläche 触覚.txt").write_bytes(saved.read_bytes())
    assert open_design(tmp_path / "Handfläche 触覚.txt").design == DESIGN
    assert design_file.SUFFIX == ".skinsource"


class OfItsOwn(Tone):
    """A tone of somebody's script."""

    __slots__ = ()


def test_a_waveform_that_nothing_could_read_is_computed_but_not_saved(tmp_path):
    design = Design(limb="synthetic-1", inputs=(track(location=7, waveform=OfItsOwn()),))
    path = tmp_path / "own.skinsource"
    with pytest.raises(InvalidInputError, match="OfItsOwn cannot be written"):
        save_design(path, design)
    assert not path.exists()
