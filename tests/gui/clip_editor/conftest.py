"""The editor of a clip, on silence and on a tone."""

import numpy as np
import pytest

from skinsource.design.waveforms import Drawn, Tone
from skinsource.specs.samples import Samples
from tests.gui.clip_editor.bench import RATE_HZ, Bench


@pytest.fixture
def flat(qtbot):
    """Silence of 0.2 s, drawn."""
    bench = Bench(qtbot, Drawn(Samples(values=np.zeros(260), sample_rate_hz=RATE_HZ)))
    bench.panel.use("pen")
    return bench


@pytest.fixture
def tone(qtbot):
    bench = Bench(qtbot, Tone(100.0, 0.0, 0.2))
    bench.panel.use("envelope")
    return bench
