"""Kinds of waveforms in a menu, each with its picture."""

import os
import sys

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QIcon
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMenu, QWidget

from skinsource.base.allocation import give_freed_memory_back
from skinsource.base.run_limited import resident_bytes
from skinsource.design.edits.edit import kind_spec
from skinsource.design.waveforms import COMMON, KINDS, MORE
from skinsource_gui.fields.kinds import PICTURE_PX, KindField, fill_kind_menu, waveform_icon
from skinsource_gui.qt.theme import LIGHT


@pytest.fixture
def menu(qtbot):
    owner = QWidget()
    qtbot.addWidget(owner)
    # Kept until the test is over: the menu goes with it.
    yield QMenu(owner)
    owner.close()


@pytest.fixture
def field(qtbot):
    field = KindField(kind_spec())
    qtbot.addWidget(field)
    field.show()
    qtbot.waitExposed(field)
    return field


def titles(menu: QMenu) -> list[str]:
    return [action.text() for action in menu.actions()]


def more_of(menu: QMenu) -> QMenu:
    return menu.findChild(QMenu, "more_kinds")


def ink(icon: QIcon, mode: QIcon.Mode = QIcon.Mode.Normal) -> np.ndarray:
    """How much of each pixel is drawn on."""
    image = icon.pixmap(PICTURE_PX, 1.0, mode).toImage()
    return np.array(
        [
            [image.pixelColor(x, y).alpha() for x in range(image.width())]
            for y in range(image.height())
        ]
    )


def test_every_kind_has_a_picture_of_its_own(qapp):
    pictures = {kind: ink(waveform_icon(kind, LIGHT)) for kind in KINDS}
    for picture in pictures.values():
        assert picture.shape == (PICTURE_PX.height(), PICTURE_PX.width())
        # From left to right, and not at the edges, where it would be cut.
        assert (picture.max(axis=0) > 0).sum() >= PICTURE_PX.width() - 8
        assert picture[0].max() < 128 > picture[-1].max()
    assert len({picture.tobytes() for picture in pictures.values()}) == len(KINDS)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only glibc can free all at once")
def test_pictures_keep_their_pixels_and_nothing_that_qt_painted_them_with(qapp):
    def held() -> int:
        give_freed_memory_back()
        return resident_bytes(os.getpid())

    draw = waveform_icon.__wrapped__  # without its cache
    draw(KINDS[0], LIGHT)
    before = held()
    pictures = [draw(kind, LIGHT) for kind in KINDS]
    assert held() < before + 20e6
    assert not any(picture.isNull() for picture in pictures)


def test_eight_kinds_are_seen_at_once_and_the_rest_under_more(menu):
    fill_kind_menu(menu, str)
    assert titles(menu) == [*(kind.title for kind in COMMON), "More"]
    assert titles(more_of(menu)) == [kind.title for kind in MORE]
    assert len(COMMON) == 8
    assert all(not action.icon().isNull() for action in menu.actions()[:8])
    assert all(not action.icon().isNull() for action in more_of(menu).actions())


@pytest.mark.parametrize("kind", [COMMON[2], MORE[1]])
def test_the_present_kind_and_the_way_to_it_are_bold(menu, kind):
    fill_kind_menu(menu, str, current=kind.__name__)
    bold = [
        action.text()
        for action in (*menu.actions(), *more_of(menu).actions())
        if action.font().bold()
    ]
    assert bold == ([kind.title] if kind in COMMON else ["More", kind.title])


def test_the_field_opens_the_menu_and_takes_what_is_chosen_there(qtbot, field):
    chosen = []
    field.edited.connect(lambda kind, gesture: chosen.append(kind))
    field.set_value("Tone")
    QTest.mouseClick(field, Qt.MouseButton.LeftButton)
    menu = field.findChild(QMenu, "kind_menu")
    qtbot.waitUntil(menu.isVisible)
    more_of(menu).actions()[0].trigger()
    menu.close()
    assert chosen == [MORE[0].__name__]
    assert field.value == MORE[0].__name__
    assert field.currentText() == MORE[0].title
    qtbot.waitUntil(lambda: field.findChild(QMenu, "kind_menu") is None)
    field.showPopup()
    assert field.findChild(QMenu, "kind_menu").isVisible()
    field.hidePopup()
