"""Times and pixels of the timeline."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skinsource_gui.plots.time_scale import SHORTEST_S, TimeScale, panned, within, zoomed

TIMES = st.floats(0, 600)


@given(TIMES, st.floats(0.01, 600), st.floats(0, 300), st.floats(50, 4000), TIMES)
def test_a_pixel_leads_back_to_its_time(start_s, length_s, left_px, width_px, time_s):
    scale = TimeScale(shown_s=(start_s, start_s + length_s), left_px=left_px, width_px=width_px)
    assert scale.time(scale.x(time_s)) == pytest.approx(time_s, abs=1e-9 * (600 + length_s))


def test_the_ends_of_what_is_shown_lie_at_the_ends_of_the_width():
    scale = TimeScale(shown_s=(1.0, 3.0), left_px=8, width_px=100)
    assert (scale.x(1.0), scale.x(3.0), scale.right_px) == (8, 108, 108)


@given(st.floats(0, 1), st.floats(0.2, 5))
def test_what_lies_under_the_pointer_stays_there_when_zooming(share, factor):
    shown = (2.0, 4.0)
    anchor_s = shown[0] + share * 2
    span_s = zoomed(shown, anchor_s, factor, (0.0, 100.0))
    length = span_s[1] - span_s[0]
    assert length == pytest.approx(2.0 / factor)
    if span_s[0] > 0:
        assert span_s[0] + share * length == pytest.approx(anchor_s)


def test_zooming_ends_where_nothing_more_could_be_seen():
    span_s = zoomed((0.0, 0.01), 0.005, 1000.0, (0.0, 1.0))
    assert span_s[1] - span_s[0] == pytest.approx(SHORTEST_S)


def test_the_whole_is_shown_by_no_range_at_all():
    assert zoomed((0.0, 1.0), 0.5, 0.5, (0.0, 1.0)) is None
    assert within((-1.0, 4.0), (0.0, 1.0)) is None


def test_nothing_beyond_the_ends_is_shown():
    assert panned((0.0, 1.0), -1.0, (0.0, 3.0)) == (0.0, 1.0)
    assert panned((1.0, 2.0), 5.0, (0.0, 3.0)) == (2.0, 3.0)
