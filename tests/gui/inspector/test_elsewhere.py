"""Values that the limb that is looked at does not have."""

import pytest

from skinsource.design.waveforms.tones import Tone
from tests.gui.inspector.bench import Bench, design_of


@pytest.fixture
def bench(qtbot):
    return Bench(qtbot, design_of(Tone()))


def test_a_place_that_is_not_on_this_hand_is_named_and_can_be_left(bench):
    bench.show(bench.design.with_input(0, location=25))
    assert (
        bench.label("inspector_heading").toolTip() == "Input place 25: Place 25, not on this hand"
    )
    box = bench.choice("location")
    assert (box.value, box.shown_text) == ("25", "25 (not available)")
    assert bench.edits == []
    box.choose("3")
    assert bench.track.location == 3
    assert box.value == "3"
    assert "not available" not in box.shown_text


def test_frequencies_end_at_half_the_rate_of_the_limb(bench):
    bench.panel.show_results(bench.results() | {"sample_rate_hz": 4000.0})
    bench.type("frequency_hz", "1500")
    assert bench.track.clips[0].waveform.frequency_hz == 1500.0
    bench.type("frequency_hz", "2000")
    assert "to 1999 Hz" in bench.label("frequency_hz_note").text()
    assert bench.track.clips[0].waveform.frequency_hz == 1500.0


def test_a_frequency_that_this_limb_cannot_play_is_shown_as_it_is(bench):
    bench.show(bench.design.with_clip(1, waveform=Tone(frequency_hz=5000.0)))
    assert bench.number("frequency_hz").value_si == 5000.0
    assert bench.edits == []
