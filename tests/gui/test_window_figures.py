"""What the window is measured by, on four screens: the skin first, and what is needed in sight."""

import pytest

from benchmarks.window_figures import SCREENS, figures_of


@pytest.mark.parametrize("screen", SCREENS, ids=lambda screen: str(screen[0]))
def test_the_figures_of_the_window_hold(open_window, screen):
    figures = figures_of(open_window(), screen)
    holds = {
        "skin": figures.skin >= (0.06 if screen[0] < 1920 else 0.08),
        "arm": figures.arm >= 0.04,
        "sensors_px": figures.sensors_px >= 20.0,
        "clicked": figures.clicked,
        "traces_px": figures.traces_px >= 180,
        "spectra_px": figures.spectra_px >= 180,
        "tracks": figures.tracks >= 5,
        "hidden": not any(figures.hidden.values()),
        "controls": len(figures.controls) <= 25,
    }
    missed = {name for name, held in holds.items() if not held}
    assert not missed, f"{missed}: {figures}"
