"""Pictures of the whole window and of each panel, in three themes and two sizes, and its figures.

make pictures     (writes build/pictures; open them and look; and docs/window.png for the README)
"""

import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import soundfile
from PIL import Image, ImageQt
from PySide6.QtGui import QPixmap
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from studio import settle, studio
from window_figures import print_figures

from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, View, track
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Chirp, Tone
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from skinsource.limbs.catalog import available_limbs, default_limb
from skinsource_gui.pages.importing.page import OverviewStrip
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.document import NEW_VIEW
from skinsource_gui.state.preferences import start_design

SIZES = ((1366, 768), (1920, 1080))
FOLDER = Path("build/pictures")
#: The picture in the README: of a synthetic limb, since nothing measured is ever committed.
README_PICTURE, README_SIZE = Path("docs/window.png"), SIZES[0]


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
        "lab": (several, six, "arrange_lab"),
        "empty": (
            Design(limb="synthetic-1"),
            View(outputs=(), selected_inputs=()),
            "arrange_design",
        ),
    }


def readme_design() -> Design:
    """Four tracks on a synthetic limb: a train of wavelets, a tone, taps and a chirp."""
    taps = tuple(Clip(onset_s=0.1 + 0.12 * k, waveform=Tap(), gain=1.0 - 0.1 * k) for k in range(6))
    return Design(
        limb="synthetic-1",
        inputs=(
            Input(location=7, clips=(Clip(waveform=WaveletTrain()),)),
            track(location=3, waveform=Tone(120.0, duration_s=0.6), amplitude=0.5, colour=1),
            Input(location=12, clips=taps, colour=2),
            track(location=18, waveform=Chirp(duration_s=0.5), colour=3, onset_s=0.2),
        ),
    )


def main() -> int:
    """Write all pictures."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    view = replace(NEW_VIEW, outputs=(29, 33, 61), axes="z", selected_inputs=(1,))
    readme_picture(readme_design(), view)
    for name, (design, view, arrangement) in scenes().items():
        for theme in ("light", "dark", "contrast"):
            for size in SIZES:
                photograph(name, design, view, arrangement, theme, size)
    print_figures()
    return 0


def readme_picture(design: Design, view: View) -> None:
    """Write the picture in the README, as if no measured limbs were installed."""
    synthetic = [name for name in available_limbs() if name.startswith("synthetic")]
    with studio(design, view, README_SIZE, theme="light", limbs=synthetic) as window:
        window.do("arrange_design")
        settle(window)
        # Conditions are judged a moment later.
        QTest.qWait(1500)
        save_small(window.grab(), README_PICTURE)
        print(README_PICTURE)


def save_small(picture: QPixmap, path: Path) -> None:
    """Write a picture in the 256 colours that are nearest to all of its own: its file is small."""
    image = ImageQt.fromqpixmap(picture).convert("RGB")
    few = image.quantize(256, kmeans=4, dither=Image.Dither.NONE)
    few.save(path, optimize=True)


def photograph(
    name: str, design: Design, view: View, arrangement: str, theme: str, size: tuple[int, int]
) -> None:
    """Write one picture of the window, and of each panel of the smaller window."""
    with studio(design, view, size, theme=theme) as window:
        window.do(arrangement)
        settle(window)
        stem = f"{name}-{theme}-{size[0]}"
        window.grab().save(str(FOLDER / f"{stem}.png"))
        if name == "several" and size == SIZES[0]:
            for panel in window.panels:
                panel.grab().save(str(FOLDER / f"{stem}-{panel.name}.png"))
            import_page(window).save(str(FOLDER / f"{stem}-import.png"))
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
