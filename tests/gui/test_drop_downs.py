"""Drop-down lists, as they look."""

from collections import Counter

import pytest
from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QColor, QFontInfo, QFontMetrics
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractSlider,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QLineEdit,
    QVBoxLayout,
    QWidget,
)

from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.choice_field import ChoiceField, DropDown
from skinsource_gui.panels.hand.layout import contrast
from skinsource_gui.qt.theme import THEMES, current_theme

SPEC = ChoiceSpec(label="Size", options=(("s", "Small"), ("m", "Medium"), ("l", "Large")))
READABLE = 4.5


@pytest.fixture(params=["light", "dark"])
def field(request, qtbot, use_theme):
    use_theme(THEMES[request.param])
    parent = QWidget()
    qtbot.addWidget(parent)
    field = ChoiceField(SPEC)
    QVBoxLayout(parent).addWidget(field)
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


def point_at(field, row, way):
    view = field.view()
    if way == "mouse":
        # A pointer that an earlier test left at the same place would not move.
        for through in (row - 1, row):
            at = view.visualRect(view.model().index(through, 0)).center()
            QTest.mouseMove(view.viewport(), at)
    else:
        for _ in range(row - view.currentIndex().row()):
            QTest.keyClick(view, Qt.Key.Key_Down)
    QApplication.processEvents()
    assert view.currentIndex().row() == row


@pytest.mark.parametrize("way", ["mouse", "keyboard"])
def test_the_highlighted_entry_can_be_read_and_stands_out(field, way):
    point_at(field, 2, way)
    ground, ink = entry_colours(field, 2)
    assert contrast(ink, ground) >= READABLE
    assert ground.name() == current_theme().accent


def test_the_other_entries_can_be_read(field):
    for row in (1, 2):
        ground, ink = entry_colours(field, row)
        assert contrast(ink, ground) >= READABLE
        assert ground.name() == current_theme().base


def test_a_name_ends_in_an_ellipsis_only_where_there_is_no_room(field, qtbot):
    field.hidePopup()
    field.setSizeAdjustPolicy(field.SizeAdjustPolicy.AdjustToContents)
    field.choose("m")
    field.setFixedWidth(field.sizeHint().width())
    fitting = field.grab().toImage()
    field.setFixedWidth(field.sizeHint().width() + 40)
    roomy = field.grab(fitting.rect().adjusted(0, 0, -30, 0)).toImage()
    assert roomy == fitting.copy(fitting.rect().adjusted(0, 0, -30, 0))


def test_the_wheel_alone_gives_the_focus_to_nothing_that_it_would_change(window):
    """Qt gives the focus before it delivers the wheel, which sent events do not do."""
    for widget in window.findChildren(QWidget):
        if isinstance(widget, QComboBox | QAbstractSpinBox | QLineEdit | QAbstractSlider):
            assert (
                not widget.focusPolicy() & Qt.FocusPolicy.WheelFocus & ~Qt.FocusPolicy.StrongFocus
            )
    assert window.findChildren(ChoiceField)


def test_every_list_that_drops_down_shows_its_arrow_and_cuts_no_entry_off(window, qtbot):
    window.docks["library"].bring_forward()
    tags = window.panel("library").search.tags
    page = window.library.ask_and_save()
    qtbot.addWidget(page)
    for field in (tags, page.what, *window.findChildren(QComboBox)):
        assert isinstance(field, DropDown)
    for field in (tags, page.what):
        shown = field.grab(QRect(field.width() - 20, field.height() // 2 - 5, 14, 10)).toImage()
        inked = {shown.pixel(x, y) for x in range(14) for y in range(10)}
        assert len(inked) > 1
    tags.showPopup()
    qtbot.waitUntil(lambda: tags.view().isVisible())
    view = tags.view()
    assert view.viewport().width() >= view.sizeHintForColumn(0)
    tags.hidePopup()
    page.reject()


def test_words_are_written_smaller_before_they_are_cut(qtbot):
    field = ChoiceField(SPEC)
    qtbot.addWidget(field)
    field.choose("m")
    whole_px = field.fontMetrics().horizontalAdvance("Medium")
    font, text = field.fitted_text(whole_px)
    assert (font, text) == (field.font(), "Medium")
    font, text = field.fitted_text(round(0.8 * whole_px))
    assert text == "Medium"
    assert QFontInfo(font).pixelSize() < QFontInfo(field.font()).pixelSize()
    assert QFontMetrics(font).horizontalAdvance("Medium") <= round(0.8 * whole_px)
    smallest, cut = field.fitted_text(whole_px // 2)
    assert cut.endswith("…")
    assert QFontInfo(smallest).pixelSize() >= round(0.7 * QFontInfo(field.font()).pixelSize()) - 1
