"""Hand, map and timeline tell a screen reader their items."""

import gc

import pytest
import shiboken6
from PySide6.QtCore import QCoreApplication, QEvent, QPoint, QRectF
from PySide6.QtGui import QAccessible
from PySide6.QtWidgets import QWidget

from skinsource import Design, View, track
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.qt.accessible import Told, tell_items

TONE = Tone(frequency_hz=100.0, duration_s=0.2)
DESIGN = Design(limb="synthetic-1", inputs=(track(7, TONE), track(12, TONE, onset_s=0.05)))


@pytest.fixture(scope="module", autouse=True)
def _told(qapp):
    tell_items()


def told_by(widget):
    """Return names, rectangles and selection of the items of a widget."""
    of = QAccessible.queryAccessibleInterface(widget)
    items = [of.child(k) for k in range(of.childCount())]
    names = [item.text(QAccessible.Text.Name) for item in items]
    return of, items, names, [k for k, item in enumerate(items) if item.state().selected]


@pytest.fixture
def studio(open_window, settle):
    window = open_window(DESIGN, View(outputs=(29, 52), selected_inputs=(2,), selected_clips=(2,)))
    settle()
    return window


def test_nothing_is_told_while_nobody_asks(studio, settle, monkeypatch):
    told = []
    for name, part in (("hand", "diagram"), ("skin", "map"), ("timeline", "lanes")):
        painted = getattr(studio.panel(name), part)
        monkeypatch.setattr(painted, "told", told.append, raising=True)
    studio.do("duplicate_clips")
    settle()
    assert not told


def test_the_hand_tells_its_places(studio):
    diagram = studio.panel("hand").diagram
    of, items, names, selected = told_by(diagram)
    assert of.role() == QAccessible.Role.List
    assert len(items) == 20
    assert selected == [11]
    assert names[11].startswith("Place 12 ")
    assert "Input 2: Tone" in names[11]
    middle = diagram.mapToGlobal(diagram.site_centre(12))
    assert items[11].rect().contains(middle)
    assert of.childAt(middle.x(), middle.y()) is items[11]
    assert (of.indexOfChild(items[11]), items[11].parent()) == (11, of)


def test_the_map_tells_outputs_and_levels(studio):
    skin = studio.panel("skin").map
    _, items, names, selected = told_by(skin)
    assert selected == [28, 51]
    assert "dB" in names[28]
    assert items[28].rect().contains(skin.mapToGlobal(skin.stage.place_of(29).toPoint()))


def test_the_timeline_tells_clips_of_the_present_design(studio):
    lanes = studio.panel("timeline").lanes
    _, items, names, selected = told_by(lanes)
    assert selected == [1]
    assert all(word in names[1] for word in ("place 12", "onset 50 ms", "duration 200 ms"))
    studio.do("remove_clips")
    assert len(told_by(lanes)[1]) == 1
    assert not items[1].isValid()


def test_items_end_with_their_widget(qtbot):
    class Painted(QWidget):
        def told_count(self):
            return 3

        def told(self, k):
            return Told(f"item {k}", QRectF(10.0 * k, 0.0, 10.0, 10.0), False)

    for _ in range(50):
        widget = Painted()
        of, items, names, _ = told_by(widget)
        assert names == ["item 0", "item 1", "item 2"]
        assert of.childAt(*widget.mapToGlobal(QPoint(15, 5)).toTuple()) is items[1]
        ids = [QAccessible.uniqueId(item) for item in items]
        widget.deleteLater()
        QCoreApplication.sendPostedEvents(widget, QEvent.Type.DeferredDelete)
        gc.collect()
        assert not any(map(shiboken6.isValid, [of, *items]))
        assert [QAccessible.accessibleInterface(number) for number in ids] == [None] * 3
