"""Inputs at places that are not on the hand that is drawn."""

from tests.gui.timeline.bench import design_of


def test_a_place_that_is_not_on_this_hand_is_named(bench):
    bench.show(design_of(7, 25))
    row = bench.row(1)
    assert row.accessibleName().startswith("Input at 25, Place 25, not on this hand: Tone")
    assert not bench.panel.grab().isNull()
