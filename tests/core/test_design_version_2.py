"""Files of version 2: five that its code wrote open with the numbers that they had."""

import json
import re
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from skinsource import codec, waveforms
from skinsource.codec import image
from skinsource.design import Design, track
from skinsource.design_file import DesignFile, open_design, save_design
from skinsource.errors import DesignFileError
from skinsource.quantities import new_graph, sources
from skinsource.signals import sample_count
from skinsource.view import View

FOLDER = Path(__file__).parents[1] / "references" / "designs-v2"
EXPECTED: dict[str, Any] = json.loads((FOLDER / "expected.json").read_text(encoding="utf-8"))
RENDERED = [name for name, about in EXPECTED.items() if about["output_levels_db"]]


def value(found: Any) -> Any:
    """What JSON holds: hexadecimal texts are floats."""
    if isinstance(found, list):
        return tuple(value(part) for part in found)
    if isinstance(found, str) and re.fullmatch(r"-?0x[01]\.?[0-9a-f]*p[+-]\d+", found):
        return float.fromhex(found)
    return found


def expected_design(about: dict[str, Any]) -> Design:
    """The design, made anew: one clip for each input, its onset that of the nearest sample."""
    inputs = []
    for known in about["inputs"]:
        own = {name: value(one) for name, one in known.items() if name not in ("kind", "waveform")}
        onset_s = sample_count(own.pop("onset_s")) / 1300.0
        recipe = {name: value(one) for name, one in known["waveform"].items() if name != "kind"}
        kind = getattr(waveforms, known["waveform"]["kind"])
        inputs.append(track(waveform=kind(**recipe), onset_s=onset_s, **own))
    words = {name: about[name] for name in ("title", "author", "notes", "licence", "scaling")}
    return Design(limb=about["limb"], inputs=tuple(inputs), **words)


@pytest.mark.parametrize("name", EXPECTED)
def test_every_bit_of_a_design_comes_back(name):
    found, expected = open_design(FOLDER / f"{name}.skinsource"), EXPECTED[name]
    design = expected_design(expected["design"])
    assert found.design == design
    assert repr(found.design) == repr(design)  # -0.0 and 0.0, 1 and 1.0 are different here
    assert found.layout == bytes.fromhex(expected["layout"])
    assert [one.id for one in found.design.clips] == [*range(1, len(design.inputs) + 1)]
    assert (found.design.markers, found.design.loop_s) == ((), None)


@pytest.mark.parametrize("name", EXPECTED)
def test_every_bit_of_a_view_comes_back(name):
    found, about = open_design(FOLDER / f"{name}.skinsource").view, EXPECTED[name]["view"]
    for field, held in about.items():
        if field != "kind":
            assert repr(getattr(found, field)) == repr(value(held)), field
    new = {field.name for field in fields(View)} - set(about)
    assert {"selected_clips", "playhead_s"} <= new
    assert all(getattr(found, name) == getattr(View(), name) for name in new)


@pytest.mark.parametrize("name", RENDERED)
def test_levels_are_those_that_the_file_had(name):
    found = open_design(FOLDER / f"{name}.skinsource")
    graph = new_graph()
    levels = graph.evaluate({"output_levels_db"}, sources(found.design, found.view))
    # Other machines and newer transforms round otherwise.
    then = [float.fromhex(level) for level in EXPECTED[name]["output_levels_db"]]
    np.testing.assert_allclose(levels["output_levels_db"], then, rtol=0, atol=1e-9)


@pytest.mark.parametrize("name", EXPECTED)
def test_saved_again_nothing_changes(name, tmp_path):
    found = open_design(FOLDER / f"{name}.skinsource")
    save_design(tmp_path / "any", found.design, found.view, layout=found.layout)
    assert repr(open_design(tmp_path / "any")) == repr(found)
    assert (tmp_path / "any").read_bytes().startswith(b"SkinSource design, version 3\n")


def test_an_onset_is_the_nearest_sample_and_half_a_sample_is_rounded_up():
    onsets = [one.onset_s * 1300 for one in open_design(FOLDER / "onsets.skinsource").design.clips]
    assert [round(one, 9) for one in onsets] == [1, 1, 0, 455, 390, 2, 10]


def rewritten(tmp_path: Path, change) -> Path:
    """What another studio would have written in version 2, with its checksum."""
    tree = codec.encode(DesignFile(design=Design(limb="synthetic-1")))
    for name in ("markers", "loop_s"):
        del tree["design"][name]
    tone = {"kind": "Tone", "frequency_hz": 90.0}
    del tree["design"]["scaling"]
    tree["design"]["inputs"] = [{"kind": "Input", "location": 7, "waveform": tone}]
    change(tree)
    (tmp_path / "old").write_bytes(image.to_image(tree, 2))
    return tmp_path / "old"


def test_what_a_file_of_version_2_lacks_takes_its_default(tmp_path):
    found = open_design(rewritten(tmp_path, lambda tree: None)).design
    expected = track(7, waveforms.Tone(frequency_hz=90.0), id=1)
    assert found == Design(limb="synthetic-1", inputs=(expected,), scaling="upstream")


def one_input(**changes: Any):
    return lambda tree: tree["design"]["inputs"][0].update(changes)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (one_input(clips=[]), "inputs/0 holds clips, which version 2 of the format did not know"),
        (one_input(onset_s=-1.0), r"Clip\.onset_s is -1\.0, expected"),
        (one_input(onset_s="0"), r"Clip\.onset_s is '0', expected"),
        (one_input(onset_s=True), r"Clip\.onset_s is True, expected"),
        (one_input(waveform={"kind": "Siren"}), "is of kind 'Siren'"),
        (one_input(location=0), r"Input\.location is 0"),
        (lambda tree: tree["design"].update(inputs=[3]), "inputs/0 is 3, expected a recipe"),
        (lambda tree: tree["design"].update(inputs={}), r"Design\.inputs is {}"),
        (lambda tree: tree.update(design=None), "design is None, expected a recipe"),
    ],
)
def test_what_version_2_did_not_write_is_refused_and_said(tmp_path, change, message):
    with pytest.raises(DesignFileError, match=message):
        open_design(rewritten(tmp_path, change))
