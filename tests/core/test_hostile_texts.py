"""Texts on the clipboard, snapshots in files and labels that mean harm, or are nearly right."""

import json

import pytest

from skinsource.base.errors import FileFormatError, InvalidInputError
from skinsource.design import edits
from skinsource.design.clips import Clip, Fragment, Lane
from skinsource.design.comparing import Snapshot
from skinsource.design.design import Design, track

FRAGMENT = Fragment(lanes=(Lane(location=7, clips=(Clip(),)),))


@pytest.mark.parametrize("value", ["1e999", '"\\ud800"', "[" * 900 + "]" * 900, "9" * 4000])
def test_what_can_be_read_and_not_be_written_is_damaged(value):
    text = json.loads(edits.fragment_text(FRAGMENT))
    text["content"] = "HERE"
    with pytest.raises(FileFormatError, match="changed on its way"):
        edits.fragment_from(json.dumps(text).replace('"HERE"', value))


def test_a_snapshot_that_could_not_be_shown_is_none():
    design = Design(limb="synthetic-1", inputs=(track(7, amplitude=2.0),))
    Snapshot(number=1, design=design, gain=500.0)
    with pytest.raises(InvalidInputError, match="amplitude"):
        Snapshot(number=1, design=design, gain=501.0)


@pytest.mark.parametrize("label", ["tap\n", "\n", "tap\u2028"])
def test_one_line_has_no_end_of_a_line(label):
    with pytest.raises(InvalidInputError, match="one line"):
        Clip(label=label)
