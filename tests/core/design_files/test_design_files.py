"""Design files: everything comes back; damage, newer studios and failing disks are refused."""

import dataclasses
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings

from skinsource import Clip, Marker, View
from skinsource.base.errors import DesignFileError, InvalidInputError, StorageError
from skinsource.design import design_file
from skinsource.design.design import MAX_INPUTS, Design, Input, track
from skinsource.design.design_file import DesignFile, open_design, save_design
from skinsource.design.waveforms import KINDS, Noise, Tap, Tone
from skinsource.specs import image, models
from skinsource.specs.models import specs_of
from tests.core.design_files.any_recipe import recipes

DESIGN = Design(
    limb="measured-1",
    inputs=(
        track(location=7, waveform=Tone(frequency_hz=123.456), amplitude=-0.1, solo=True, id=5),
        track(location=20, waveform=Noise(seed=9, window="hanning"), onset_s=0.1, colour=3),
        track(location=1, waveform=Tap(), muted=True, colour=1),
    ),
    scaling="relative",
    title="Größe → 触覚",
    notes="First line\nsecond line",
)
VIEW = View(
    outputs=(72, 1), selected_inputs=(5,), panels=(("skin", (("map_range_db", (-60.5, -10.0)),)),)
)
LAYOUT = b"\0arrangement\0\xff\0"


@pytest.fixture
def saved(tmp_path) -> Path:
    path = tmp_path / "design.skinsource"
    save_design(path, DESIGN, VIEW, layout=LAYOUT)
    return path


@settings(
    max_examples=40,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(content=recipes(DesignFile))
def test_what_was_saved_is_opened_and_saved_again_as_the_same_bytes(tmp_path, content):
    first, second = tmp_path / "first.skinsource", tmp_path / "second.skinsource"
    save_design(first, content.design, content.view, layout=content.layout)
    opened = open_design(first)
    assert opened == content
    assert repr(opened) == repr(content)  # -0.0 and 0.0, 1 and 1.0 are different here
    save_design(second, opened.design, opened.view, layout=opened.layout)
    assert second.read_bytes() == first.read_bytes()


def test_a_file_holds_design_view_and_arrangement_whatever_it_is_called(saved, tmp_path):
    other = tmp_path / "Handfläche 触覚.txt"
    other.write_bytes(saved.read_bytes())
    opened = open_design(other)
    assert opened == DesignFile(design=DESIGN, view=VIEW, layout=LAYOUT)
    assert [track.id for track in opened.design.inputs] == [5, 1, 2]
    save_design(str(saved), DESIGN)
    assert open_design(str(saved)) == DesignFile(design=DESIGN)


def test_every_field_of_what_is_saved_describes_itself():
    for kind in (DesignFile, Design, Input, Clip, Marker, View, *KINDS):
        names = [field.name for field in dataclasses.fields(kind) if field.init]
        assert list(specs_of(kind)) == names, kind


def test_a_design_of_as_many_inputs_as_there_may_be_comes_back(tmp_path):
    inputs = tuple(track(location=1 + k % 20, colour=k) for k in range(MAX_INPUTS))
    design = Design(limb="synthetic-2", inputs=inputs)
    save_design(tmp_path / "large", design, layout=bytes(2**20))
    assert open_design(tmp_path / "large").design == design
    with pytest.raises(InvalidInputError, match="at most 1048576 bytes"):
        save_design(tmp_path / "larger", design, layout=bytes(2**20 + 1))
    assert [path.name for path in tmp_path.iterdir()] == ["large"]


class OfItsOwn(Tone):
    """A tone of somebody's script."""

    __slots__ = ()


def test_a_waveform_that_nothing_could_read_is_computed_but_not_saved(tmp_path):
    design = Design(limb="synthetic-1", inputs=(track(location=7, waveform=OfItsOwn()),))
    path = tmp_path / "own.skinsource"
    with pytest.raises(InvalidInputError, match="OfItsOwn cannot be written"):
        save_design(path, design)
    assert not path.exists()


@pytest.mark.parametrize("stored", [b"", b"\x89HDF\r\n\x1a\n", bytes(10_000), b"PK\x03\x04" * 500])
def test_what_is_no_design_file_is_refused(tmp_path, stored):
    (tmp_path / "any").write_bytes(stored)
    with pytest.raises(DesignFileError, match=r"not a SkinSource design, or damaged"):
        open_design(tmp_path / "any")
    with pytest.raises(StorageError, match="cannot be read"):
        open_design(tmp_path / "absent")


def rewritten(path: Path, change) -> None:
    """Write what another studio would have written: another tree, with its checksum."""
    tree = models.encode(DesignFile(design=DESIGN, view=VIEW))
    change(tree)
    path.write_bytes(image.to_image(tree, design_file.VERSION))


def clip_of(tree: dict, index: int) -> dict:
    """Tree of the clip of one of the inputs."""
    return tree["design"]["inputs"][index]["clips"][0]


def input_of(tree: dict) -> dict:
    """Tree of the first input."""
    return tree["design"]["inputs"][0]


OTHERS = {
    "view holds zoom": lambda tree: tree["view"].update(zoom=2.0),
    "the content holds scenes": lambda tree: tree.update(scenes=[]),
    "waveform holds harmonics": lambda tree: clip_of(tree, 0)["waveform"].update(harmonics=3),
    "clips/0/waveform is of kind 'Siren'": lambda tree: clip_of(tree, 1).update(
        waveform={"kind": "Siren"}
    ),
    "clips/0/effects/0 is of kind 'Echo'": lambda tree: clip_of(tree, 1).update(
        effects=[{"kind": "Echo"}]
    ),
}


@pytest.mark.parametrize("message", OTHERS)
def test_what_a_newer_studio_wrote_is_refused_and_said(saved, message):
    rewritten(saved, OTHERS[message])
    with pytest.raises(DesignFileError, match=message) as caught:
        open_design(saved)
    assert str(caught.value).startswith("design.skinsource: ")
    assert str(caught.value).endswith("Open it with a newer SkinSource studio.")


WRONG = {
    r"Tone\.frequency_hz is 0": lambda tree: clip_of(tree, 0)["waveform"].update(frequency_hz=0.0),
    r"Input\.clips is 'all'": lambda tree: input_of(tree).update(clips="all"),
    r"Input\.gain_curve is .*, expected": lambda tree: input_of(tree).update(
        gain_curve=[[1.0, 0.5], [0.5, 1.0]]
    ),
    r"Input\.location is 'nnnn.{70,80}…, expected": lambda tree: input_of(tree).update(
        location="n" * 10**6
    ),
    r"ids of the inputs": lambda tree: input_of(tree).update(id=1),
    r"inputs/0 lacks location": lambda tree: input_of(tree).pop("location"),
}


@pytest.mark.parametrize("message", WRONG)
def test_a_value_that_cannot_be_or_is_missing_is_refused_and_said(saved, message):
    rewritten(saved, WRONG[message])
    with pytest.raises(DesignFileError, match=message) as caught:
        open_design(saved)
    assert len(str(caught.value)) < 600
    assert ".." not in str(caught.value)


@pytest.mark.parametrize(
    ("version", "studio"),
    [(2, "the SkinSource studio that wrote it"), (4, "a newer SkinSource studio")],
)
def test_a_file_of_another_version_is_refused_in_one_sentence(saved, version, studio):
    saved.write_bytes(image.to_image(models.encode(DesignFile(design=DESIGN)), version))
    with pytest.raises(DesignFileError) as caught:
        open_design(saved)
    assert str(caught.value) == (
        f"design.skinsource: it is written in version {version} of its format, expected 3; open "
        f"it with {studio}."
    )


def test_an_upgrade_is_all_it_takes_to_read_the_version_before(saved, monkeypatch):
    # A pretended version 4 has a title where version 3 had a name.
    rewritten(saved, lambda tree: tree["design"].update(name=tree["design"].pop("title")))
    monkeypatch.setattr(design_file, "VERSION", 4)
    with pytest.raises(DesignFileError, match="version 3 of its format, expected 4"):
        open_design(saved)

    def to_version_4(tree):
        design = dict(tree["design"])
        name = design.pop("name")
        return {**tree, "design": {**design, "title": name}}

    monkeypatch.setattr(design_file, "UPGRADES", {3: to_version_4})
    older = open_design(saved)
    assert older == DesignFile(design=DESIGN, view=VIEW)
    save_design(saved, older.design, older.view)
    assert saved.read_bytes().startswith(b"SkinSource design, version 4\n")
    assert open_design(saved) == older
