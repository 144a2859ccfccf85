"""Pictures of the whole window and of each panel, light and dark, in two sizes.

make pictures     (writes build/pictures; open them and look)
"""

import os
import sys
import tempfile
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")

import numpy as np
import soundfile
from PySide6.QtGui import QPixmap
from PySide6.QtWidgets import QApplication

from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.limbs.catalogue import available_limbs, default_limb
from skinsource_gui.app.app import make_application
from skinsource_gui.pages.importing.form import OverviewStrip
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import Preferences, start_design

SIZES = ((1366, 768), (1920, 1080))
FOLDER = Path("build/pictures")


def scenes() -> dict[str, tuple[Design, View, str]]:
    """Design, view and arrangement of each picture."""
    limb = default_limb()
    several = Design(
        limb=limb,
        inputs=(
            track(location=7, waveform=Tone(frequency_hz=100.0)),
            track(location=3, waveform=Noise(seed=3), amplitude=0.5, colour=1, onset_s=0.05),
            track(location=18, waveform=Tap(), amplitude=-2.0, colour=2, onset_s=0.1),
            track(location=12, waveform=Tone(frequency_hz=640.0), colour=3, muted=True),
        ),
    )
    six = View(outputs=(29, 30, 33, 35, 38, 61), axes="z", selected_inputs=(2,))
    return {
        "start": (start_design(limb), View(), "arrange_design"),
        "several": (several, six, "arrange_design"),
        "together": (several, View(axes="z", selected_inputs=(2, 4, 1)), "arrange_design"),
        "stacked": (
            several,
            View(
                outputs=(29, 30, 33, 52),
                axes="z",
                delay_removed=True,
                panels=(
                    ("skin", (("map_style", "sensors"),)),
                    ("spectra", (("layout", "stacked"), ("log_frequency", True))),
                    ("traces", (("layout", "stacked"),)),
                ),
            ),
            "arrange_design",
        ),
        "analysis": (several, six, "arrange_analysis"),
        "presentation": (several, six, "arrange_presentation"),
        "empty": (
            Design(limb="synthetic-1"),
            View(outputs=(), selected_inputs=()),
            "arrange_design",
        ),
    }


def main() -> int:
    """Write all pictures."""
    make_application()
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name, (design, view, arrangement) in scenes().items():
        for theme in ("light", "dark"):
            for size in SIZES:
                photograph(name, design, view, arrangement, theme, size)
    return 0


def photograph(
    name: str, design: Design, view: View, arrangement: str, theme: str, size: tuple[int, int]
) -> None:
    """Write one picture of the window, and of each panel of the smaller window."""
    with tempfile.TemporaryDirectory() as folder:
        preferences = Preferences(Path(folder) / "studio.ini")
        preferences.theme_name = theme
        window = MainWindow(
            design, view=view, preferences=preferences, available_limbs=available_limbs()
        )
        window.resize(*size)
        window.show()
        window.do(arrangement)
        QApplication.processEvents()
        window.catch_up()
        QApplication.processEvents()
        stem = f"{name}-{theme}-{size[0]}"
        window.grab().save(str(FOLDER / f"{stem}.png"))
        if name == "several" and size == SIZES[0]:
            for panel in window.panels:
                panel.grab().save(str(FOLDER / f"{stem}-{panel.name}.png"))
            import_page(window).save(str(FOLDER / f"{stem}-import.png"))
        window.close()
        print(FOLDER / f"{stem}.png")


def import_page(window: MainWindow) -> QPixmap:
    """The page on a recording of half a minute, of which a part is taken."""
    time = np.arange(30 * 8000) / 8000.0
    taps = sum(np.exp(-(((time - at) * 40.0) ** 2)) for at in range(1, 30, 3))
    noise = 0.05 * np.random.default_rng(0).standard_normal(time.size)
    path = Path(tempfile.mkdtemp()) / "taps on cork.wav"
    soundfile.write(path, 0.8 * taps * np.sin(2.0 * np.pi * 180.0 * time) + noise, 8000)
    window.imports.open_page(path)
    (page,) = window.imports.pages
    while page.busy or not page.ready:
        QApplication.processEvents()
    page.form.take_part(6.0, 8.0)
    strip = page.findChild(OverviewStrip)
    while page.busy or strip.extremes is None:
        QApplication.processEvents()
    picture = page.grab()
    page.reject()
    return picture


if __name__ == "__main__":
    sys.exit(main())
