"""Panels are printed as lines and letters, and stay as they are on the screen."""

import re

import pytest

import skinsource as ss
from skinsource_gui.plots.pictures import save_drawing
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
def test_axes_and_names_of_clips_are_words_on_a_page(open_window, settle, tmp_path, name, labels):
    window = open_window(DESIGN)
    settle()
    page = page_of(window, name, tmp_path / "a.pdf")
    text = page.text()
    assert [word for word in labels if word not in text] == [], text
    # Nothing is a picture of the screen, and no colour is changed.
    assert b"DCTDecode" not in page.images()


def test_the_hand_is_printed_finer_than_it_is_shown(open_window, settle, tmp_path):
    window = open_window(DESIGN)
    settle()
    page = page_of(window, "hand", tmp_path / "a.pdf")
    widths = [
        int(re.search(rb"/Width (\d+)", pdf_object)[1])
        for pdf_object in page.objects.values()
        if b"/Subtype /Image" in pdf_object
    ]
    assert max(widths) >= 6 * window.panel("hand").width()
