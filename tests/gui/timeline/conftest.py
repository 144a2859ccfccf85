import pytest

from tests.gui.timeline.bench import PLACES, Bench, LanesBench, design_of


@pytest.fixture
def bench(qtbot):
    return Bench(qtbot, design_of(*PLACES))


@pytest.fixture
def lanes(qtbot):
    return LanesBench(qtbot)
