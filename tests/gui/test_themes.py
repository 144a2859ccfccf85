"""Colours change while the studio is open, in all that is seen; drop-down lists, as they look."""

from collections import Counter

import pytest
from PySide6 import QtWidgets
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest

from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.qt.theme import THEMES, current_theme
from skinsource_gui.shell.panels import PANELS
from tests.gui.hand.bench import contrast

#: What is known of the sound card comes at any time.
# The stage is in motion.
NAMES = [spec.panel.name for spec in PANELS if spec.panel.name not in ("output", "stage")]


def make_all(window):
    """Each panel that comes changes the room of the others."""
    for name in NAMES:
        window.panel(name)
        window.docks[name].show()
    QtWidgets.QApplication.processEvents()


def pictures(window):
    """Of each panel, and of the buttons that play, without the frame of the keyboard."""
    images = {"bar": window.playback.bar.grab().toImage()}
    for name in NAMES:
        window.docks[name].show()
        window.docks[name].raise_()
        QtWidgets.QApplication.processEvents()
        window.catch_up()
        window.setFocus()
        QtWidgets.QApplication.processEvents()
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


SPEC = ChoiceSpec(label="Size", options=(("s", "Small"), ("m", "Medium"), ("l", "Large")))
READABLE = 4.5


@pytest.fixture(params=["light", "dark"])
def field(request, qtbot, use_theme):
    use_theme(THEMES[request.param])
    parent = QtWidgets.QWidget()
    qtbot.addWidget(parent)
    field = ChoiceField(SPEC)
    QtWidgets.QVBoxLayout(parent).addWidget(field)
    parent.show()
    qtbot.waitExposed(parent)
    field.showPopup()
    qtbot.waitUntil(lambda: field.view().isVisible())
    yield field
    field.hidePopup()


def entry_colours(field, row):
    """Ground of an entry, and the pixel on it that stands out most: the ink of its words."""
    view = field.view()
    area = view.visualRect(view.model().index(row, 0)).adjusted(3, 3, -3, -3)
    picture = view.viewport().grab(area).toImage()
    counted = Counter(
        picture.pixel(x, y) for y in range(picture.height()) for x in range(picture.width())
    )
    ground = QColor(counted.most_common(1)[0][0])
    ink = max((QColor(argb) for argb in counted), key=lambda colour: contrast(colour, ground))
    return ground, ink


def test_the_highlighted_entry_can_be_read_and_stands_out(field):
    for _ in range(2):
        QTest.keyClick(field.view(), Qt.Key.Key_Down)
    QtWidgets.QApplication.processEvents()
    assert field.view().currentIndex().row() == 2
    ground, ink = entry_colours(field, 2)
    assert contrast(ink, ground) >= READABLE
    assert ground.name() == current_theme().accent


def test_the_wheel_alone_gives_the_focus_to_nothing_that_it_would_change(window):
    """Qt gives the focus before it delivers the wheel, which sent events do not do."""
    for widget in window.findChildren(QtWidgets.QWidget):
        if isinstance(
            widget,
            QtWidgets.QComboBox
            | QtWidgets.QAbstractSpinBox
            | QtWidgets.QLineEdit
            | QtWidgets.QAbstractSlider,
        ):
            assert (
                not widget.focusPolicy() & Qt.FocusPolicy.WheelFocus & ~Qt.FocusPolicy.StrongFocus
            )
    assert window.findChildren(ChoiceField)
