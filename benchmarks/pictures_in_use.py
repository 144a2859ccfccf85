"""Pictures of timeline, editor, library and import in use, light and dark, in two sizes.

python benchmarks/pictures_in_use.py     (writes build/pictures; open them and look)
"""

import sys

from pictures import FOLDER, SIZES, import_page
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QListView, QPushButton
from studio import settle, studio

from skinsource.design.clips import Clip, Marker
from skinsource.design.design import Design, Input, View
from skinsource.design.effects.level import Envelope, Fade
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from skinsource.design.waveforms.wavelets import Gabor
from skinsource.limbs.catalog import default_limb
from skinsource_gui.shell.window import MainWindow

_RISE = Envelope(points=((0.0, 0.0), (0.08, 1.0, "smooth"), (0.3, 0.6), (0.6, 0.0)))


def composed() -> Design:
    """Four tracks: a train, a tone with an envelope, taps, noise that is muted."""
    taps = tuple(Clip(onset_s=0.1 + 0.12 * k, waveform=Tap(), gain=1.0 - 0.1 * k) for k in range(6))
    tones = (
        Clip(onset_s=0.0, waveform=Tone(120.0, duration_s=0.6), effects=(_RISE,)),
        Clip(onset_s=0.7, waveform=Gabor(200.0), label="a touch"),
    )
    noise = (Clip(onset_s=0.2, waveform=Noise(duration_s=0.5), effects=(Fade(),)),)
    return Design(
        limb=default_limb(),
        inputs=(
            Input(location=7, clips=(Clip(waveform=WaveletTrain()),)),
            Input(location=3, clips=tones, colour=1, amplitude=0.5),
            Input(location=12, clips=taps, colour=2, gain_curve=((0.0, 1.0), (0.8, 0.2))),
            Input(location=18, clips=noise, colour=3, muted=True),
        ),
        markers=(Marker(time_s=0.3, name="contact"),),
        loop_s=(0.1, 0.7),
    )


def main() -> int:
    """Write all pictures."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    for theme in ("light", "dark"):
        for size in SIZES:
            photograph(theme, size)
    return 0


def photograph(theme: str, size: tuple[int, int]) -> None:
    """Write the four pictures of one theme and size."""
    view = View(selected_inputs=(2,), selected_clips=(2,), playhead_s=0.3)
    with studio(composed(), view, size, theme=theme) as window:
        window.do("arrange_design")
        keep(window, "timeline", theme, size)
        window.do("show_clip_editor")
        window.panel("clip_editor").setFocus(Qt.FocusReason.TabFocusReason)
        QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_E)
        keep(window, "editor", theme, size)
        window.do("arrange_design")
        window.docks["library"].bring_forward()
        rows = window.panel("library").findChild(QListView, "preset_rows")
        settle(window)
        rows.setCurrentIndex(rows.model().index(3, 0))
        keep(window, "library", theme, size)
        import_page(window).save(str(FOLDER / f"import-{theme}-{size[0]}.png"))
        matching_page(window, theme, size)


def matching_page(window: MainWindow, theme: str, size: tuple[int, int]) -> None:
    """Save pictures of the matching page: what is asked first, and a rehearsal."""
    window.do("match_strength")
    page = window.playback.matching.page
    page.form.field("person").setText("P 07")
    page.grab().save(str(FOLDER / f"matching-{theme}-{size[0]}.png"))
    page.findChild(QPushButton, "matching_rehearse").click()
    while not page.view.lit:
        settle(window)
    page.grab().save(str(FOLDER / f"matching-run-{theme}-{size[0]}.png"))
    page.reject()


def keep(window: MainWindow, name: str, theme: str, size: tuple[int, int]) -> None:
    """Save a picture of the window as it is."""
    settle(window)
    QTest.qWait(200)
    path = FOLDER / f"{name}-{theme}-{size[0]}.png"
    window.grab().save(str(path))
    print(path)


if __name__ == "__main__":
    sys.exit(main())
