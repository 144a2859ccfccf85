"""Pictures of panels and of all of them, for paper, slides and posters; films and packs."""

import re
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QImage, QPainter, QPdfWriter
from PySide6.QtWidgets import QAbstractButton, QApplication, QComboBox, QFileDialog, QLabel

import skinsource as ss
from skinsource import Actuation, ActuatorAt, View
from skinsource.actuators.equalising import RegularisedInverse
from skinsource.design.panel_settings import with_settings
from skinsource_gui.panels.analysis.transfer import TransferView
from skinsource_gui.panels.compare.settings import CompareSettings
from skinsource_gui.panels.skin.film import FilmOptions
from skinsource_gui.plots.colour_maps import colour_table
from skinsource_gui.plots.pictures import (
    ALL_VISIBLE,
    caption_of,
    drawn_image,
    save_drawing,
    with_caption,
)
from skinsource_gui.plots.small_map import FieldImage
from skinsource_gui.qt.frames import fitted
from skinsource_gui.qt.theme import DARK, LIGHT, current_theme
from tests.core.test_in_time import SHORT as DESIGN
from tests.gui.analysis.analysis_bench import analysis
from tests.gui.exporting import press, shown
from tests.gui.menus import close_menus, lines_at
from tests.gui.pages_of_paper import Paper


def texts_of(path):
    return re.sub(r"<[^>]+>", "\n", path.read_text("utf-8"))


def test_a_caption_says_what_is_played_where_how_strong_and_on_which_limb():
    assert caption_of(DESIGN) == (
        "Place 7, 1 m/s²: Tone 100 Hz, 200 ms; Place 13, −2 m/s²: Tap, 16.2 ms at 50 ms. "
        "Limb: Synthetic 1 (175 mm); scaling: probe acceleration."
    )
    muted = DESIGN.with_input(0, muted=True)
    assert "Place 7" not in caption_of(muted)
    assert caption_of(replace(DESIGN, inputs=(), title="A")).startswith("A. No active input")
    many = replace(DESIGN, inputs=tuple(ss.track(place) for place in range(1, 10)))
    assert "and 3 more inputs" in caption_of(many)
    one_more = replace(DESIGN, inputs=many.inputs[:7])
    assert "and 1 more input." in caption_of(one_more)


def test_a_caption_names_what_shapes_the_stimulus_and_what_it_is_predicted_through():
    tone = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)
    rising = ss.effects.Envelope(points=((0.0, 0.0), (0.1, 1.0), (0.2, 0.5)))
    plain = replace(DESIGN, inputs=(ss.track(7, tone),))
    shaped = ss.edits.set_gain_curve(plain, ss.View(), 1, ((0.0, 1.0), (0.1, 0.0))).design
    strength = "gain 1, peak 0.757 m/s², with a gain curve of 2 points"
    assert f"Place 7, {strength}: Tone" in caption_of(shaped)
    effects = (rising, ss.effects.Fade(), ss.effects.Reverse(on=False), ss.effects.Envelope())
    clip = replace(shaped.inputs[0].clips[0], effects=effects)
    inside = replace(plain, inputs=(replace(plain.inputs[0], clips=(clip,)),))
    assert "200 ms through an envelope of 3 points, fade. Limb" in caption_of(inside)
    coil = ActuatorAt(model=ss.actuators.load("example-voice-coil"))
    driven = replace(plain, actuation=Actuation(actuators=(coil,), equaliser=RegularisedInverse()))
    assert "Place 7, 1 m/s²: Tone" in caption_of(driven)
    caption = caption_of(driven)
    assert caption.endswith(f"; predicted through {driven.actuated.words}.")
    volts = replace(driven, actuation=replace(driven.actuation, equaliser=None))
    assert "Place 7, 1 V: Tone" in caption_of(volts)
    assert "1 V" in volts._repr_html_()


def test_a_caption_takes_room_from_the_picture_and_covers_none_of_it():
    heights = []

    def draw(painter, width, height, theme):
        heights.append(height)
        painter.fillRect(0, 0, width, height, QColor("red"))

    picture = drawn_image(with_caption(draw, "words " * 300), 300, 200)
    assert 130 < heights[0] < 200
    assert QColor(picture.pixel(150, heights[0] - 1)).name() == "#ff0000"
    assert QColor(picture.pixel(299, 199)).name() == LIGHT.base


@pytest.mark.parametrize(("dpi", "pixels"), [(96, 300), (192, 600), (48, 150)])
def test_dots_in_an_inch_are_as_chosen(tmp_path, dpi, pixels):
    def draw(painter, width, height):
        assert (width, height) == (300, 200)
        painter.fillRect(0, 0, width, height, QColor("blue"))

    save_drawing(tmp_path / "a.png", draw, 300, 200, dpi=dpi)
    picture = QImage(str(tmp_path / "a.png"))
    assert picture.width() == pixels
    assert picture.dotsPerMeterX() == pytest.approx(dpi / 0.0254, abs=1)
    assert QColor(picture.pixel(pixels - 1, picture.height() - 1)).name() == "#0000ff"


def test_pictures_are_on_light_ground_and_the_studio_stays_dark(open_window, qtbot):
    window = open_window(DESIGN)
    window.do("use_dark_theme")
    # Of the status bar, what was judged and how long it took come when there is time.
    above = window.rect().adjusted(0, 0, 0, -window.statusBar().height())
    qtbot.waitUntil(lambda: bool(window.conditions.chip.findings), timeout=30_000)
    for _ in range(3):  # what follows from other colours is laid out, and then painted
        QApplication.processEvents()
    before = window.grab(above).toImage()
    draw = window.pictures.picture_of(ALL_VISIBLE).draw
    picture = drawn_image(draw, 900, 600)
    assert QColor(picture.pixel(899, 599)).name() == LIGHT.base
    assert current_theme() == DARK
    qtbot.waitUntil(lambda: window.grab(above).toImage() == before)


def test_what_to_cite_is_copied(open_window, qapp):
    open_window(DESIGN).do("copy_citation")
    assert "10.1109/HAPTICS59260.2024.10520852" in qapp.clipboard().text()


def test_a_film_asks_for_its_size_and_begins_with_it_the_next_time(
    window, qtbot, monkeypatch, write_with, tmp_path
):
    given, suggested, answers = [], [], {}

    def name_it(_window, _title, start, kinds):
        suggested.append((Path(start).name, kinds))
        return answers["save"], ""

    monkeypatch.setattr(QFileDialog, "getSaveFileName", name_it)

    def wait():
        qtbot.waitUntil(lambda: not window.runner.busy, timeout=20_000)

    window.panel("skin").map.stage.pan_zoom.show("hand")
    window.document.look(replace(window.document.view, slow_motion=20.0))
    write_with("animation", lambda *_, options, seen, **more: given.append((options, seen.fit)))
    chosen = FilmOptions(width_px=640, height_px=480, colours="dark", kind=".webm", pace="200")

    answers["save"] = str(tmp_path / "film.mp4")
    part = shown(window, "animation")
    assert (part.form.options.width_px, part.form.options.height_px) == (900, 1200)
    assert "frames" in part.form.remark.text
    qtbot.waitUntil(lambda: not part.image.image.isNull(), timeout=20_000)
    for name in ("width_px", "height_px", "colours", "kind", "pace"):
        part.form._edit(name, getattr(chosen, name), None)
    press(part)
    wait()
    assert suggested == [("skin-map-along-z-1-200.webm", "WebM (*.webm);;MP4 (*.mp4);;GIF (*.gif)")]
    assert given == [(chosen, "hand")]
    # The next time it begins with these; cancelled, nothing is asked or written any more.
    part = shown(window, "animation")
    assert part.form.options == chosen
    # What was found follows the design again.
    part.form._edit("pace", "50", None)
    window.document.look(replace(window.document.view, slow_motion=100.0))
    assert shown(window, "animation").form.options.pace == "100"
    window.exports.end()
    assert len(given) == 1


def test_a_film_that_cannot_be_written_says_so_before_anything_is_asked(window, monkeypatch):
    # As where it is not installed.
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    part = shown(window, "animation")
    message = part.findChild(QLabel, "file_problem").text()
    assert message.lower().startswith("the package 'imageio_ffmpeg' is needed for this")
    assert "[video]" in message
    assert not part.ready
    window.exports.end()


ONE_TONE = replace(DESIGN, inputs=DESIGN.inputs[:1])


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
def printed(open_window, settle):
    window = open_window(ONE_TONE)
    settle()
    return window


def test_what_nobody_looked_at_is_drawn_whole_and_stays_where_it_was(make_window, tmp_path, qtbot):
    window = make_window(ONE_TONE)
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
    qtbot.waitUntil(lambda: not any("limb" in slot for slot in slots), timeout=10_000)
    # They come into the window as ever.
    dock = window.docks["analysis"]
    dock.bring_forward()
    panel = window.panel("analysis")
    qtbot.waitUntil(panel.isVisible)
    assert panel.window() is window


def test_text_in_a_pdf_is_text_and_colours_are_not_packed_with_loss(printed, tmp_path):
    for name, titles in (
        ("skin", ("Skin acceleration, RMS over the whole record",)),
        ("traces", ("Time (ms)",)),
        ("analysis/regions", ("Back of the hand",)),
        ("timeline", ("050100150200", "Tone")),
        ("clip_editor", ("0.8", "200 ms", "−60")),
    ):
        page = page_of(printed, name, tmp_path / "a.pdf", (600, 900))
        page_text = page.text()
        assert [title for title in titles if title not in page_text] == [], name
        assert "Place 7, 1 m/s²: Tone 100 Hz, 200 ms" in page_text
        assert set(page.images()) <= {b"FlateDecode"}
        assert page.images() or name != "skin"


def test_the_hand_is_printed_finer_than_it_is_shown(printed, tmp_path):
    page = page_of(printed, "hand", tmp_path / "a.pdf")
    widths = [
        int(re.search(rb"/Width (\d+)", pdf_object)[1])
        for pdf_object in page.objects.values()
        if b"/Subtype /Image" in pdf_object
    ]
    assert max(widths) >= 6 * printed.panel("hand").width()


@pytest.mark.parametrize(("name", "bars"), [("compare", 4), ("analysis/windowed", 1)])
def test_each_limb_has_a_bar_of_millimetres_on_paper(printed, tmp_path, name, bars):
    of_limbs = with_settings(printed.document.view, "compare", CompareSettings(of="limbs"))
    printed.document.look(of_limbs)
    page = page_of(printed, name, tmp_path / "a.pdf")
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
    window = open_window(ONE_TONE, View(selected_inputs=(1,), outputs=(20, 26)))
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
