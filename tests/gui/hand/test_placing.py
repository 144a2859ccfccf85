"""The hand panel, driven by real mouse and key events."""

from itertools import combinations

import pytest
from PySide6.QtCore import QPoint, QPointF
from PySide6.QtTest import QTest

from skinsource.design.design import MAX_INPUTS, track
from skinsource.design.waveforms.pulses import Noise
from skinsource.design.waveforms.tones import Tone
from tests.gui.hand.bench import CONTROL, KEY, LEFT, NONE, SHIFT

# Placing and selecting


@pytest.mark.parametrize("site", range(1, 21))
def test_a_click_on_an_empty_site_places_an_input_there_and_selects_it(studio, site):
    studio.click(site)
    assert studio.sites == [site]
    assert studio.view.selected_input == 1
    assert studio.order == ["design"]
    assert studio.edits[0][0].startswith(f"Place input at {site} (")


def test_sites_are_far_enough_apart_to_be_hit_at_the_smallest_size(studio):
    points = [studio.diagram.site_centre(site) for site in range(1, 21)]
    for first, other in combinations(points, 2):
        offset = first - other
        assert offset.x() ** 2 + offset.y() ** 2 >= 22**2
    for site, point in enumerate(points, start=1):
        for off in (QPoint(0, 11), QPoint(0, -11), QPoint(11, 0), QPoint(-11, 0)):
            assert studio.diagram.stage.layout.site_at(QPointF(point + off)) == site
            assert studio.diagram.rect().contains(point + off)


def test_a_click_beside_the_sites_does_nothing(studio):
    QTest.mouseClick(studio.diagram, LEFT, NONE, QPoint(2, 2))
    assert studio.edits == []


def test_a_new_input_copies_waveform_and_amplitude_of_the_selected_one(studio):
    first = track(location=7, waveform=Tone(frequency_hz=60.0))
    second = track(location=8, waveform=Noise(), amplitude=0.25, onset_s=0.5, muted=True)
    studio.show(first, second, selected=1)
    studio.click(18)
    new = studio.design.inputs[2]
    assert (new.clips[0].waveform, new.amplitude) == (Noise(seed=1), 0.25)
    assert (new.clips[0].onset_s, new.muted, new.colour) == (0.0, False, 2)


def test_a_new_input_is_plain_where_none_is_selected(studio):
    studio.show(track(location=8, waveform=Noise(), amplitude=0.25))
    studio.click(18)
    assert studio.design.inputs[1].clips[0].waveform == track(location=18).clips[0].waveform
    assert studio.design.inputs[1].amplitude == track(location=18).amplitude


def test_a_click_on_an_input_selects_it_and_edits_nothing(studio):
    studio.show(track(location=7), track(location=3), selected=0)
    studio.click(3)
    assert studio.view.selected_input == 2
    assert studio.edits == []


def test_repeated_clicks_cycle_through_the_inputs_of_a_site(studio):
    studio.show(track(location=7), track(location=3), track(location=3), track(location=3))
    selected = []
    for _ in range(5):
        studio.click(3)
        selected.append(studio.view.selected_input)
    assert selected == [4, 2, 3, 4, 2]
    assert studio.edits == []


def test_a_click_with_shift_and_control_adds_a_further_input(studio):
    studio.show(track(location=3), selected=0)
    studio.click(3, SHIFT | CONTROL)
    assert studio.sites == [3, 3]
    assert studio.view.selected_input == 2


@pytest.mark.parametrize("modifier", [SHIFT, CONTROL])
def test_a_click_with_shift_or_control_adds_to_the_selected_ones_or_takes_out(studio, modifier):
    studio.show(track(location=3), track(location=7), track(location=9), selected=0)
    studio.click(7, modifier)
    studio.click(9, modifier)
    assert studio.view.selected_inputs == (1, 2, 3)
    assert [mark.chosen for mark in studio.diagram.state.marks] == [True] * 3
    studio.click(7, modifier)
    assert studio.view.selected_inputs == (1, 3)
    assert studio.edits == []


@pytest.mark.parametrize("modifier", [SHIFT, CONTROL])
def test_on_an_empty_site_they_place_an_input_and_select_it_besides_the_others(studio, modifier):
    studio.click(3, modifier)
    assert studio.sites == [3]
    assert studio.view.selected_inputs == (1,)
    studio.click(8, modifier)
    assert studio.sites == [3, 8]
    assert studio.view.selected_inputs == (1, 2)
    studio.click(8, CONTROL | SHIFT)
    assert studio.view.selected_inputs == (3,)


def test_ctrl_a_selects_all_and_delete_removes_all_in_one_step(studio):
    studio.show(*(track(location=site) for site in (7, 8, 9)), selected=1)
    studio.keys(KEY.Key_A, modifier=CONTROL)
    assert studio.view.selected_inputs == (1, 3, 2)
    studio.keys(KEY.Key_Delete)
    assert studio.sites == []
    assert len(studio.edits) == 1


def test_a_full_design_says_so_and_takes_no_more(studio):
    studio.show(*[track(location=3)] * MAX_INPUTS)
    studio.click(7)
    assert studio.edits == []
    assert str(MAX_INPUTS) in studio.refusals[-1]
