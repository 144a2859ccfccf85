"""A field of several inputs, typed or dragged."""

import pytest

from skinsource.design.view import View
from skinsource_gui.fields.inputs import FieldChanges
from tests.gui.timeline.bench import design_of

BOTH = View(selected_inputs=(1, 2))


def onsets_s(design):
    return [track.clips[0].onset_s for track in design.inputs]


def change(changes, design, value, gesture):
    ids = BOTH.selected_inputs
    return changes.change(design, BOTH, ids, "onset_s", value, lead=2, gesture=gesture).design


@pytest.fixture
def design():
    design = design_of(7, 2)
    return design.with_clip(1, onset_s=0.05).with_clip(2, onset_s=0.2)


def test_the_way_back_of_a_drag_leads_where_it_began_also_from_a_limit(design):
    changes = FieldChanges()
    at_limit = change(changes, design, 0.0, gesture=1)
    assert onsets_s(at_limit) == [0.0, 0.0]
    assert onsets_s(change(changes, at_limit, 0.2, gesture=1)) == [0.05, 0.2]


def test_another_drag_begins_where_the_last_one_ended(design):
    changes = FieldChanges()
    at_limit = change(changes, design, 0.0, gesture=1)
    assert onsets_s(change(changes, at_limit, 0.2, gesture=2)) == [0.2, 0.2]


def test_a_typed_value_sets_all(design):
    assert onsets_s(change(FieldChanges(), design, 0.3, gesture=None)) == [0.3, 0.3]
