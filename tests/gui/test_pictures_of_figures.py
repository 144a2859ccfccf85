"""Pictures of panels with a figure hold that and words, no controls, and are filled."""

import numpy as np
import pytest
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QAbstractButton, QComboBox

import skinsource as ss
from skinsource.design.view import View
from skinsource_gui.plots.pictures import drawn_image, save_drawing
from skinsource_gui.qt.theme import LIGHT
from tests.gui.analysis.analysis_bench import analysis
from tests.gui.analysis.test_linearity_panel import show
from tests.gui.test_pictures_out import texts_of

__all__ = ["show"]

DESIGN = ss.Design(
    limb="synthetic-1",
    inputs=(ss.track(7, ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)),),
)
SLIDE_PX = (1280, 720)


def in_front(open_window, qtbot, name):
    window = open_window(DESIGN, View(outputs=(20, 26)))
    panel = analysis(window, name)
    qtbot.waitUntil(lambda: not window.engine.busy and not panel.figure.message, timeout=30_000)
    return window, panel


def inked(image):
    """The ground's height and width, and where on it anything is drawn: rows, columns."""
    bits = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), -1, 4)
    ground = QColor(LIGHT.base)
    other = (bits[..., :3] != [ground.blue(), ground.green(), ground.red()]).any(axis=2)
    return np.flatnonzero(other.any(axis=1)), np.flatnonzero(other.any(axis=0))


@pytest.mark.parametrize("name", ["spectrogram", "transfer", "main_axis"])
def test_a_picture_of_a_figure_has_no_controls(open_window, qtbot, tmp_path, name):
    window, panel = in_front(open_window, qtbot, name)
    path = tmp_path / "a.svg"
    save_drawing(path, window.pictures.picture_of("analysis").draw, *SLIDE_PX)
    texts = texts_of(path)
    assert panel._result.split(" · ")[0].split()[0] in texts
    assert "Copy" not in texts
    for control in (*panel.findChildren(QAbstractButton), *panel.findChildren(QComboBox)):
        text = control.currentText() if isinstance(control, QComboBox) else control.text()
        # What is chosen may be said in words.
        assert not text or text not in texts or text in panel.picture_text + panel._result


@pytest.mark.parametrize("name", ["spectrogram", "transfer"])
def test_a_picture_of_a_figure_fills_the_slide(open_window, qtbot, name):
    window, panel = in_front(open_window, qtbot, name)
    image = drawn_image(panel.draw_picture, *SLIDE_PX)
    del window
    rows, columns = inked(image)
    assert columns[0] < 0.05 * SLIDE_PX[0]
    assert columns[-1] > 0.93 * SLIDE_PX[0]
    assert rows[-1] > 0.93 * SLIDE_PX[1]
