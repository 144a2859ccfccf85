"""What the wheel does to the part of the time that is seen."""

import pytest
from PySide6.QtCore import QPointF, Qt

from skinsource_gui.plots.time_scale import TimeScale, range_by_wheel
from tests.gui.wheel import wheel_event

SCALE = TimeScale(shown_s=(0.4, 0.6), left_px=10.0, width_px=200.0)
HELD = Qt.KeyboardModifier


def turned(x, y, held=HELD.NoModifier, at_px=60.0, whole_s=(0.0, 1.0)):
    at = QPointF(at_px, 5.0)
    event = wheel_event(at, at, (x, y), held)
    return range_by_wheel(event, SCALE, whole_s)


@pytest.mark.parametrize(
    ("turn", "held"),
    [
        ((0, 120), HELD.NoModifier),
        ((0, 120), HELD.ControlModifier),
        ((120, 0), HELD.ControlModifier),
    ],
)
def test_a_notch_zooms_around_the_pointer(qapp, turn, held):
    low, high = turned(*turn, held)
    assert high - low == pytest.approx(0.2 / 1.2)
    # A quarter of the width lies left of the pointer, before and after.
    assert low + 0.25 * (high - low) == pytest.approx(0.45)


@pytest.mark.parametrize(
    ("turn", "held"), [((0, -120), HELD.ShiftModifier), ((-120, 0), HELD.NoModifier)]
)
def test_with_shift_or_sideways_it_goes_along_the_time(qapp, turn, held):
    assert turned(*turn, held) == pytest.approx((0.42, 0.62))


def test_it_ends_where_the_time_does_and_at_the_whole(qapp):
    assert turned(-12000, 0) == pytest.approx((0.8, 1.0))
    assert turned(0, -12000) is None
