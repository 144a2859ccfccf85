"""Design files that another studio wrote: an older one, a newer one, and one that errs."""

import dataclasses
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from skinsource.base.errors import DesignFileError
from skinsource.design import design_file
from skinsource.design.design import Input
from skinsource.design.design_file import DesignFile, open_design, save_design
from skinsource.design.view import View
from skinsource.specs import fields, image, models
from skinsource.specs.numbers import NumberSpec, SamplesSpec
from skinsource.specs.samples import Samples
from skinsource.specs.spec import TextSpec
from tests.core.design_files.bench import DESIGN, VIEW


def rewritten(path: Path, change) -> None:
    """Write what another studio would have written: another tree, with its checksum."""
    tree = models.encode(DesignFile(design=DESIGN, view=VIEW))
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


@pytest.mark.parametrize(
    ("version", "studio"),
    [
        (1, "the SkinSource studio that wrote it"),
        (2, "the SkinSource studio that wrote it"),
        (4, "a newer SkinSource studio"),
    ],
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
    kind = dataclasses.make_dataclass("Input", [], bases=(RicherInput,), frozen=True, kw_only=True)
    monkeypatch.setattr("skinsource.design.design_file.View", view)
    monkeypatch.setattr("skinsource.design.design.Input", kind)
    return {"View": view, "Input": kind}


def test_a_new_field_needs_no_other_file_touched(saved, tomorrow):
    older = open_design(saved)
    assert older.view.speed == 0.5
    assert older.view.outputs == VIEW.outputs
    assert [track.label for track in older.design.inputs] == ["", "", ""]
    assert older.design.inputs[0].amplitude == -0.1
    sound = Samples(values=np.arange(9.0), sample_rate_hz=1300.0)
    marked = [replace(track, label="left", recorded=sound) for track in older.design.inputs]
    design = replace(older.design, inputs=tuple(marked))
    save_design(saved, design, replace(older.view, speed=2.25))
    opened = open_design(saved)
    assert opened.view.speed == 2.25
    assert opened.design == design
    assert opened.design.inputs[0].recorded == sound


def test_the_studio_of_today_refuses_what_the_one_of_tomorrow_wrote(saved, tomorrow, monkeypatch):
    older = open_design(saved)
    save_design(saved, older.design, older.view)
    monkeypatch.undo()
    with pytest.raises(DesignFileError, match=r"holds .*newer SkinSource studio"):
        open_design(saved)
