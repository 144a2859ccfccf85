"""Panels are printed as lines and letters, and stay as they are on the screen."""

import re

import pytest
from PySide6.QtWidgets import QGraphicsView

import skinsource as ss
from skinsource_gui.plots.pictures import drawn_image, save_drawing
from tests.gui.pages_of_paper import Paper

DESIGN = ss.Design(
    limb="synthetic-1",
    inputs=(ss.track(7, ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)),),
)


def page_of(window, name, path):
    picture = window.pictures.picture_of(name)
    save_drawing(path, picture.draw, *(picture.size_px or (900, 600)))
    return Paper(path)


@pytest.mark.parametrize(
    ("name", "labels"),
    [("timeline", ("100150200", "Tone")), ("clip_editor", ("0.8", "200 ms", "−60"))],
)
def test_axes_and_names_of_clips_are_words_on_a_page(make_window, settle, tmp_path, name, labels):
    window = make_window(DESIGN)
    settle()
    page = page_of(window, name, tmp_path / "a.pdf")
    text = page.text()
    assert [word for word in labels if word not in text] == [], text
    # Nothing is a picture of the screen, and no colour is changed.
    assert b"DCTDecode" not in page.images()


def test_what_is_kept_as_a_picture_on_the_screen_is_so_afterwards(make_window, settle):
    window = make_window(DESIGN)
    settle()
    panel = window.panel("timeline")

    def modes():
        views = panel.findChildren(QGraphicsView)
        return [
            (view.cacheMode(), [item.cacheMode() for item in view.scene().items()])
            for view in views
        ]

    before, image = modes(), panel.grab().toImage()
    drawn_image(window.pictures.picture_of("timeline").draw, 900, 300)
    assert modes() == before
    assert panel.grab().toImage() == image


def test_the_hand_is_printed_finer_than_it_is_shown(make_window, settle, tmp_path):
    window = make_window(DESIGN)
    settle()
    page = page_of(window, "hand", tmp_path / "a.pdf")
    widths = [
        int(re.search(rb"/Width (\d+)", pdf_object)[1])
        for pdf_object in page.objects.values()
        if b"/Subtype /Image" in pdf_object
    ]
    assert max(widths) >= 6 * window.panel("hand").width()


def test_curves_that_panels_hold_are_as_wide_as_other_lines(make_window, settle, tmp_path):
    window = make_window(DESIGN)
    settle()
    for name in ("inspector", "clip_editor", "actuator", "timeline"):
        picture = window.pictures.picture_of(name)
        save_drawing(tmp_path / "a.svg", picture.draw, *(picture.size_px or (900, 600)))
        drawing = (tmp_path / "a.svg").read_text("utf-8")
        paths = re.findall(r"<(?:path|polyline)[^>]*>", drawing)
        curves = [path for path in paths if len(path) > 2000]
        assert curves, name
        assert not any("non-scaling-stroke" in curve for curve in curves), name
