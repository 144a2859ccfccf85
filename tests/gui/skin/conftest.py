import numpy as np
import pytest

from skinsource import load_limb, surface_operator
from skinsource_gui.panels.skin.panel import SkinPanel
from tests.gui.skin.bench import SEED, Window


@pytest.fixture(scope="module")
def results():
    limb = load_limb("synthetic-1")
    surface = surface_operator(limb)
    levels = np.random.default_rng(SEED).uniform(-60, -12, 72)
    levels[28] = -11.0
    return {
        "limb_data": limb,
        "match_gain": 1.0,
        "record_samples": 1040,
        "limb_map": limb.map,
        "surface": surface,
        "output_levels_db": levels,
        "surface_levels_db": surface.interpolate(levels),
    }


@pytest.fixture
def window(qtbot, results):
    window = Window(SkinPanel(), results)
    window.appear(qtbot, 420, 640)
    window.deliver()
    window.panel.map.stage.show_arm(shown=True)
    return window
