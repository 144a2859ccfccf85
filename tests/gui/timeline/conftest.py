import pytest

from tests.gui.timeline.bench import PLACES, Bench, design_of


@pytest.fixture
def bench(qtbot):
    return Bench(qtbot, design_of(*PLACES))
