"""Where edges come to rest."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skinsource_gui.plots import time_scale


@pytest.mark.parametrize(
    ("edges_s", "by_s", "neighbours_s", "grid_s", "rest"),
    [
        # Near another clip, with a guide; of two edges the nearer one decides.
        ((0.1, 0.3), 0.198, [0.5], None, (0.2, 0.5)),
        ((0.0, 1.0), 0.5, [0.505, 1.503], None, (0.503, 1.503)),
        ((0.1,), 0.2, [0.35], None, (0.2, None)),
        # A clip goes before the grid, which the first edge follows without a guide.
        ((0.0,), 0.104, [0.107], 0.1, (0.107, 0.107)),
        ((0.013, 0.2), 0.084, [], 0.05, (0.087, None)),
    ],
)
def test_where_edges_come_to_rest(edges_s, by_s, neighbours_s, grid_s, rest):
    snap = time_scale.snap_of(edges_s, by_s, neighbours_s=neighbours_s, grid_s=grid_s, reach_s=0.01)
    assert (snap.by_s, snap.guide_s) == (pytest.approx(rest[0]), rest[1])


@given(
    st.lists(st.floats(0, 10), max_size=8).map(sorted),
    st.floats(0, 10),
    st.floats(-10, 10),
    st.floats(1e-4, 0.5),
)
def test_no_edge_moves_further_than_the_reach_or_half_a_step_of_the_grid(
    neighbours, edge, by_s, reach
):
    rest = time_scale.snap_of((edge,), by_s, neighbours_s=neighbours, grid_s=0.1, reach_s=reach)
    assert abs(rest.by_s - by_s) <= max(reach, 0.05) * (1 + 1e-9) + 1e-12
    if rest.guide_s is not None:
        assert edge + rest.by_s == pytest.approx(rest.guide_s)


@given(st.floats(0.1, 1e6))
def test_lines_of_the_grid_are_round_and_can_be_told_apart(px_per_s):
    step = time_scale.grid_step_s(px_per_s)
    assert 12 * (1 - 1e-9) <= step * px_per_s < 12 * 2.6
    assert f"{step:.0e}"[0] in "125"


TIMES = st.floats(0, 600)


@given(TIMES, st.floats(0.01, 600), st.floats(0, 300), st.floats(50, 4000), TIMES)
def test_a_pixel_leads_back_to_its_time(start_s, length_s, left_px, width_px, time_s):
    scale = time_scale.TimeScale(
        shown_s=(start_s, start_s + length_s), left_px=left_px, width_px=width_px
    )
    assert scale.time(scale.x(time_s)) == pytest.approx(time_s, abs=1e-9 * (600 + length_s))


def test_zooming_ends_where_nothing_more_could_be_seen():
    span_s = time_scale.zoomed((0.0, 0.01), 0.005, 1000.0, (0.0, 1.0))
    assert span_s[1] - span_s[0] == pytest.approx(time_scale.SHORTEST_S)


def test_nothing_beyond_the_ends_is_shown():
    assert time_scale.panned((0.0, 1.0), -1.0, (0.0, 3.0)) == (0.0, 1.0)
    assert time_scale.panned((1.0, 2.0), 5.0, (0.0, 3.0)) == (2.0, 3.0)
