"""Colours change while the studio is open, in all that is seen; pens of outputs differ."""

from PySide6.QtWidgets import QApplication

from skinsource_gui.qt.theme import THEMES
from skinsource_gui.shell.panels import PANELS

#: What is known of the sound card comes at any time.
# The stage is in motion.
NAMES = [spec.panel.name for spec in PANELS if spec.panel.name not in ("output", "stage")]


def make_all(window):
    """Each panel that comes changes the room of the others."""
    for name in NAMES:
        window.panel(name)
        window.docks[name].show()
    QApplication.processEvents()


def pictures(window):
    """Of each panel, and of the buttons that play, without the frame of the keyboard."""
    images = {"bar": window.playback.bar.grab().toImage()}
    for name in NAMES:
        window.docks[name].show()
        window.docks[name].raise_()
        QApplication.processEvents()
        window.catch_up()
        window.setFocus()
        QApplication.processEvents()
        images[name] = window.panel(name).grab().toImage()
    return images


def test_colours_that_are_chosen_later_are_those_of_a_window_that_opens_in_them(
    make_window, preferences
):
    preferences.theme_name = "contrast"
    window = make_window()
    make_all(window)
    opened = pictures(window)
    preferences.theme_name = "light"
    window = make_window()
    make_all(window)
    light = window.panel("skin").grab().toImage()
    window.do("use_contrast_theme")
    chosen = pictures(window)
    assert [name for name in opened if opened[name] != chosen[name]] == []
    assert chosen["skin"] != light


def test_thirty_two_outputs_differ_in_colour_or_strokes():
    for theme in THEMES.values():
        pens = [theme.output_pen(rank, 0.0) for rank in range(32)]
        assert len({(pen.color().name(), tuple(pen.dashPattern())) for pen in pens}) == 32
        # The first of them have whole lines.
        assert all(not pens[rank].dashPattern() for rank in range(8))
