"""Saving designs: everything comes back, and what fails keeps the last file."""

import dataclasses
import errno
import os
import re
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings

from skinsource.base.errors import InvalidInputError, StorageError
from skinsource.design import design_file
from skinsource.design.clips import Clip, Marker
from skinsource.design.design import MAX_INPUTS, Design, Input, track
from skinsource.design.design_file import DesignFile, open_design, save_design
from skinsource.design.view import View
from skinsource.design.waveforms import KINDS
from skinsource.design.waveforms.tones import Tone
from skinsource.specs import image
from skinsource.specs.models import specs_of
from tests.core.design_files.any_recipe import recipes
from tests.core.design_files.bench import DESIGN, LAYOUT, VIEW


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
    opened = open_design(first)
    assert opened == content
    assert repr(opened) == repr(content)  # -0.0 and 0.0, 1 and 1.0 are different here
    save_design(second, opened.design, opened.view, layout=opened.layout)
    assert second.read_bytes() == first.read_bytes()


def test_a_file_holds_design_view_and_arrangement(saved):
    opened = open_design(saved)
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
    save_design(tmp_path / "large", design, layout=bytes(10**6))
    assert open_design(tmp_path / "large").design == design


def test_more_arrangement_than_fits_is_refused_before_anything_is_written(tmp_path):
    with pytest.raises(InvalidInputError, match="at most 1048576 bytes"):
        save_design(tmp_path / "large", DESIGN, layout=bytes(2**20 + 1))
    assert not list(tmp_path.iterdir())


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
