"""A picture of a panel that nobody looked at is whole; nothing in a picture has the keyboard."""

import re

import pytest

import skinsource as ss
from skinsource_gui.plots.pictures import save_drawing
from tests.gui.pages_of_paper import Paper

DESIGN = ss.Design(
    limb="synthetic-1",
    inputs=(ss.track(7, ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)),),
)
#: What can be read in the picture of a panel only once it was laid out and told results.
SAYS = {
    "analysis/regions": ("Back of the hand", "Forearm", "Mean"),
    "compare": ("Edited", "Snapshot 1", "dB re 1 m/s²"),
    "analysis_2/wave": ("Way along the line (mm)", "Speed"),
    "actuator": ("Peak velocity", "Boost", "Overlaid", "Stiffness"),
    "history": ("New design",),
}


@pytest.fixture
def open_window(make_window):
    """Each test has a window of its own."""
    return make_window


@pytest.fixture
def window(make_window, settle):
    window = make_window(DESIGN)
    window.document.edit("Softer", DESIGN.with_input(0, amplitude=0.5))
    window.do("store_snapshot_1")
    window.document.undo_stack.undo()
    settle()
    return window


def text_of(window, name, path):
    picture = window.pictures.picture_of(name)
    save_drawing(path, picture.draw, *(picture.size_px or (900, 700)))
    return re.sub(r"<[^>]+>", "\n", path.read_text("utf-8")).replace("\N{NO-BREAK SPACE}", " ")


def test_what_nobody_looked_at_is_drawn_whole_and_stays_where_it_was(
    window, settle, tmp_path, qtbot
):
    window.activateWindow()
    window.panel("hand").setFocus()
    focused = window.focusWidget()
    for name, expected in SAYS.items():
        drawn_text = text_of(window, name, tmp_path / "a.svg")
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
    settle()
    panel = window.panel("analysis")
    assert panel.isVisible()
    assert panel.window() is window
    assert panel.width() <= dock.width()


def test_text_in_a_pdf_is_text_and_colours_are_not_packed_with_loss(window, tmp_path):
    for name, title in (
        ("skin", "Skin acceleration, RMS over the whole record"),
        ("traces", "Time (ms)"),
        ("analysis/regions", "Back of the hand"),
    ):
        picture = window.pictures.picture_of(name)
        save_drawing(tmp_path / "a.pdf", picture.draw, 600, 900)
        paper = Paper(tmp_path / "a.pdf")
        # Qt writes the blank of some fonts as a tab.
        page_text = paper.text().replace("\t", " ")
        assert title in page_text, name
        assert "Tone 100 Hz, 200 ms" in page_text
        assert set(paper.images()) <= {b"FlateDecode"}
        assert paper.images() or name != "skin"
