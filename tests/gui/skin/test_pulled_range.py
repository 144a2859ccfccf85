"""A range of levels that is pulled along its scale."""

from skinsource_gui.panels.skin.scale import PulledRange
from skinsource_gui.panels.skin.settings import moved, with_high


def test_the_scale_goes_beyond_the_range_and_follows_it():
    pulled_range = PulledRange((-60.0, -10.0))
    assert pulled_range.axis_db == (-66.0, -4.0)
    pulled_range.show((-60.0, 40.0))
    assert pulled_range.axis_db == (-72.0, 52.0)


def test_while_it_is_held_the_scale_stays_and_it_is_pulled_from_where_it_was():
    pulled_range = PulledRange((-60.0, -10.0))
    pulled_range.hold()
    for part, expected in ((0.1, (-53.8, -3.8)), (0.2, (-47.6, 2.4)), (0.0, (-60.0, -10.0))):
        assert pulled_range.pulled(moved, part) == expected
        pulled_range.show(expected)
        assert pulled_range.axis_db == (-66.0, -4.0)
    pulled_range.show((-47.6, 2.4))
    pulled_range.release()
    assert pulled_range.axis_db == (-53.6, 8.4)


def test_nothing_is_wanted_of_a_range_that_is_not_held_or_not_yet_pulled():
    pulled_range = PulledRange((-60.0, -10.0))
    assert pulled_range.pulled(moved, 0.5) is None
    pulled_range.hold()
    assert pulled_range.pulled(moved, 0.0005) is None
    assert pulled_range.pulled(lambda held, by: with_high(held, held[1] + by), 0.5) == (-60.0, 21.0)
