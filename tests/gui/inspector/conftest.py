import pytest

from skinsource.design.waveforms.pulses import Impulse, Noise, Tap
from skinsource.design.waveforms.tones import Tone
from tests.gui.inspector.bench import Bench, design_of


@pytest.fixture
def bench(qtbot):
    return Bench(qtbot, design_of(Tone(), Noise(seed=5), Tap(), Impulse()))
