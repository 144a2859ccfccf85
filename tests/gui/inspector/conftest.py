import pytest

from skinsource.design.waveforms import Impulse, Noise, Tap, Tone
from tests.gui.inspector.bench import Bench, design_of


@pytest.fixture
def bench(qtbot):
    return Bench(qtbot, design_of(Tone(), Noise(seed=5), Tap(), Impulse()))
