"""Pictures of panels on pages and slides: words and lines, whole, without controls."""

import re

import numpy as np
import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QPainter, QPdfWriter
from PySide6.QtWidgets import QAbstractButton, QComboBox

import skinsource as ss
from skinsource.design.panel_settings import with_settings
from skinsource.design.view import View
from skinsource_gui.panels.analysis.transfer import TransferView
from skinsource_gui.panels.compare.settings import CompareSettings
from skinsource_gui.plots.colour_maps import colour_table
from skinsource_gui.plots.pictures import drawn_image, save_drawing
from skinsource_gui.plots.small_map import FieldImage
from skinsource_gui.qt.frames import fitted
from skinsource_gui.qt.theme import LIGHT
from tests.gui.analysis.analysis_bench import analysis
from tests.gui.menus import close_menus, lines_at
from tests.gui.pages_of_paper import Paper
from tests.gui.test_pictures_out import texts_of

DESIGN = ss.Design(
    limb="synthetic-1",
    inputs=(ss.track(7, ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)),),
)
SLIDE_PX = (1280, 720)
#: What can be read in the picture of a panel only once it was laid out and told results.
SAYS = {
    "analysis/regions": ("Back of the hand", "Forearm", "Mean"),
    "compare": ("Store the design with Ctrl+Shift+1 to 4",),
    "analysis/wave": ("Distance along the line (mm)", "Speed"),
}


def page_of(window, name, path, size=(900, 600)):
    picture = window.pictures.picture_of(name)
    save_drawing(path, picture.draw, *(picture.size_px or size))
    return Paper(path)


@pytest.fixture
def shown(open_window, settle):
    window = open_window(DESIGN)
    settle()
    return window


def test_what_nobody_looked_at_is_drawn_whole_and_stays_where_it_was(make_window, tmp_path, qtbot):
    window = make_window(DESIGN)
    window.activateWindow()
    window.panel("hand").setFocus()
    focused = window.focusWidget()
    for name, expected in SAYS.items():
        assert name.partition("/")[0] not in window.panels or name == "analysis/wave"
        picture = window.pictures.picture_of(name)
        save_drawing(tmp_path / "a.svg", picture.draw, *(picture.size_px or (900, 700)))
        drawn_text = texts_of(tmp_path / "a.svg").replace("\N{NO-BREAK SPACE}", " ")
        assert [text for text in expected if text not in drawn_text] == [], name
        name = name.partition("/")[0]
        panel, dock = window.panel(name), window.docks[name]
        assert dock.isAncestorOf(panel)
        assert not panel.isVisible()
        assert not dock.isVisible() or not dock.in_sight
    assert window.focusWidget() is focused
    # Nothing is predicted for them any more.
    slots = window.engine._graphs
    qtbot.waitUntil(lambda: not any("limb" in slot.name for slot in slots), timeout=10_000)
    # They come into the window as ever.
    dock = window.docks["analysis"]
    dock.bring_forward()
    panel = window.panel("analysis")
    qtbot.waitUntil(panel.isVisible)
    assert panel.window() is window


def test_text_in_a_pdf_is_text_and_colours_are_not_packed_with_loss(shown, tmp_path):
    for name, titles in (
        ("skin", ("Skin acceleration, RMS over the whole record",)),
        ("traces", ("Time (ms)",)),
        ("analysis/regions", ("Back of the hand",)),
        ("timeline", ("050100150200", "Tone")),
        ("clip_editor", ("0.8", "200 ms", "−60")),
    ):
        page = page_of(shown, name, tmp_path / "a.pdf", (600, 900))
        page_text = page.text()
        assert [title for title in titles if title not in page_text] == [], name
        assert "Place 7, 1 m/s²: Tone 100 Hz, 200 ms" in page_text
        assert set(page.images()) <= {b"FlateDecode"}
        assert page.images() or name != "skin"


def test_the_hand_is_printed_finer_than_it_is_shown(shown, tmp_path):
    page = page_of(shown, "hand", tmp_path / "a.pdf")
    widths = [
        int(re.search(rb"/Width (\d+)", pdf_object)[1])
        for pdf_object in page.objects.values()
        if b"/Subtype /Image" in pdf_object
    ]
    assert max(widths) >= 6 * shown.panel("hand").width()


@pytest.mark.parametrize(("name", "bars"), [("compare", 4), ("analysis/windowed", 1)])
def test_each_limb_has_a_bar_of_millimetres_on_paper(shown, tmp_path, name, bars):
    of_limbs = with_settings(shown.document.view, "compare", CompareSettings(of="limbs"))
    shown.document.look(of_limbs)
    page = page_of(shown, name, tmp_path / "a.pdf")
    assert len(re.findall(r"0 mm(?!\))", page.text())) == bars


def test_maps_that_share_a_surface_are_as_many_pictures_in_a_pdf(qapp, tmp_path):
    spacing = np.arange(5.0, 25.0)
    field = FieldImage(np.ones((20, 20), bool), spacing, spacing, px_per_mm=2.0)
    falling, rising = np.full((20, 20), 10.0), np.full((20, 20), 30.0)
    writer = QPdfWriter(str(tmp_path / "maps.pdf"))
    painter = QPainter(writer)
    for rank, levels in enumerate((falling, rising)):
        place = QRectF(200.0 * rank, 0.0, 150.0, 150.0)
        field.paint(painter, fitted(field.rect, place), place, levels, (0.0, 40.0), colour_table())
    painter.end()
    assert len(Paper(tmp_path / "maps.pdf").images()) == 2


def inked(image):
    """Rows and columns in which anything is drawn on the ground."""
    bits = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), -1, 4)
    ground = QColor(LIGHT.base)
    other = (bits[..., :3] != [ground.blue(), ground.green(), ground.red()]).any(axis=2)
    return np.flatnonzero(other.any(axis=1)), np.flatnonzero(other.any(axis=0))


def open_figure(open_window, qtbot, name):
    window = open_window(DESIGN, View(selected_inputs=(1,), outputs=(20, 26)))
    panel = analysis(window, name)
    qtbot.waitUntil(panel.isVisible)
    qtbot.waitUntil(lambda: not window.engine.busy and not panel.figure.message, timeout=30_000)
    return window, panel


@pytest.mark.parametrize("name", ["spectrogram", "transfer", "main_axis"])
def test_a_picture_of_a_figure_has_no_controls_and_fills_the_slide(
    open_window, qtbot, tmp_path, name
):
    window, panel = open_figure(open_window, qtbot, name)
    save_drawing(tmp_path / "a.svg", window.pictures.picture_of(f"analysis/{name}").draw, *SLIDE_PX)
    texts = texts_of(tmp_path / "a.svg")
    assert panel._result.split(" · ")[0].split()[0] in texts
    for control in (*panel.findChildren(QAbstractButton), *panel.findChildren(QComboBox)):
        text = control.currentText() if isinstance(control, QComboBox) else control.text()
        # What is chosen may be said in words.
        assert not text or text not in texts or text in panel.picture_text + panel._result
    if name == "main_axis":
        return  # it is square
    rows, columns = inked(drawn_image(panel.draw_picture, *SLIDE_PX))
    assert columns[0] < 0.05 * SLIDE_PX[0]
    assert columns[-1] > 0.93 * SLIDE_PX[0]
    assert rows[-1] > 0.93 * SLIDE_PX[1]


def test_the_right_button_on_a_figure_offers_its_picture_and_numbers(qtbot):
    panel, asked = TransferView(), []
    qtbot.addWidget(panel)
    panel.action_requested.connect(asked.append)
    panel.show()
    panel.activateWindow()
    qtbot.waitUntil(panel.isActiveWindow)
    panel.figure.say("")
    lines = lines_at(panel.figure, "figure_menu", panel.figure, panel.figure.rect().center())
    lines["Save picture as…"].trigger()
    close_menus(panel.figure, "figure_menu")
    # The action saves the panel that has the keyboard focus.
    assert asked == ["export_panel_picture"]
    assert panel.figure.hasFocus()
    assert "Copy numbers" in lines
