"""In letters of any size, on small and large screens, each panel has room, scrolls, or is a tab."""

from itertools import pairwise

import pytest
from PySide6.QtCore import QRect, QSize
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import QAbstractButton, QApplication, QLabel

from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.fields.grid import FieldGrid
from skinsource_gui.plots.axis import Axis
from skinsource_gui.plots.plot import Plot
from skinsource_gui.shell.appearance import LARGEST_TEXT
from skinsource_gui.shell.arrangement_spec import ArrangementSpec, Place
from skinsource_gui.shell.dock_layout import Needs, folded, room_of

FIELDS = View(selected_inputs=(1,), outputs=(29, 30, 33, 35))


@pytest.fixture
def studio(open_window):
    tone = Tone(frequency_hz=120.0, duration_s=0.4)
    window = open_window(Design(limb="synthetic-1", inputs=(track(7, tone),)), FIELDS)
    yield window
    window.appearance.reset_text()
    window.appearance.fit_room(1.0)


@pytest.fixture
def settle(qtbot, studio):
    """Wait until results are shown and docks have shared the room."""
    settling = studio.layout_of_docks.settling
    timers = settling._widened, settling._settled

    def wait():
        qtbot.waitUntil(lambda: not studio.engine.busy, timeout=30_000)
        QApplication.processEvents()
        qtbot.waitUntil(lambda: not any(timer.isActive() for timer in timers))

    return wait


def in_sight(window):
    return [dock for dock in window.docks.values() if dock.isVisible() and dock.in_sight]


def too_wide(dock):
    return dock.panel.width() > dock.widget().viewport().width()


def numbers(plot):
    """How many numbers are written at each axis."""
    axes = [item for item in plot.scene().items() if isinstance(item, Axis) and item.isVisible()]
    return [len(axis.labels()) for axis in axes]


def cut(window):
    """Words of buttons and labels of panels in sight that have too little room."""
    cut = []
    for dock in in_sight(window):
        for button in dock.panel.findChildren(QAbstractButton):
            if button.isVisible() and QFontMetrics(button.font()).horizontalAdvance(
                button.text()
            ) > max(button.width(), 1):
                cut.append(button.text())
        for grid in dock.panel.findChildren(FieldGrid):
            cut += [
                label.text()
                for label in grid.findChildren(QLabel)
                if label.isVisible()
                and label.text()
                and label.height() < label.fontMetrics().height()
            ]
    return cut


@pytest.mark.parametrize(("scale", "screen"), [(1.0, (1366, 768)), (3.0, (1920, 1080))])
def test_nothing_is_cut_or_scrolls_sideways(studio, settle, scale, screen):
    window = studio
    window.resize(*screen)
    window.appearance._scale_text(scale)
    for arrangement in ("design", "presentation", "analysis"):
        window.do(f"arrange_{arrangement}")
        settle()
        settle()
        wide = [dock.objectName() for dock in in_sight(window) if too_wide(dock)]
        assert (arrangement, wide, cut(window)) == (arrangement, [], [])

        for name in ("traces", "spectra"):
            window.docks[name].bring_forward()
            settle()
            (plot,) = window.panel(name).findChildren(Plot)

            assert min(numbers(plot)) >= 2, (arrangement, name)


def test_in_the_largest_letters_nothing_lies_on_the_map_or_on_the_ends_of_its_range(studio, settle):
    def of(part, panel):
        return QRect(part.mapTo(panel, part.rect().topLeft()), part.size())

    studio.appearance._scale_text(LARGEST_TEXT)
    studio.resize(1366, 768)
    settle()
    panel = studio.panel("skin")
    layout, bar = panel.map.stage.layout, panel.colour_bar
    # All of the limb is in sight, beside the cards.
    limb = layout.frame.transform().mapRect(panel.map.content.field.rect)
    for output in range(1, 61):
        point = panel.map.stage.place_of(output)
        assert layout.room.contains(point)
        assert not layout.palmar_card.contains(point)
    assert limb.height() > 0.5 * panel.map.height()
    assert layout.room.contains(layout.palmar_card)
    fields = [bar.high_field, bar.strip, bar.low_field]
    shown = [*fields, *([bar.auto_button] if bar.auto_button.isVisible() else [])]
    places = [of(widget, bar) for widget in shown]
    for above, below in pairwise(places):
        assert above.bottom() < below.top()
    assert places[-1].bottom() <= bar.height()
    for field in (bar.high_field, bar.low_field):
        assert field.height() >= field.fontMetrics().height()


SPEC = ArrangementSpec(
    name="a", text="a", hint="", keys=(), columns=(1, 1, 1), host="mid", yields=("right", "left")
)
PLACES = {
    "left": Place(0),
    "mid": Place(1),
    "right": Place(2, 50),
    "under": Place(2, 50),
    "foot": Place(0, 30, at_foot=True),
}
COLUMNS = (("left",), ("mid",), ("right", "under"))


def needs(width, height, spec=SPEC):
    least = dict.fromkeys(PLACES, QSize(100, 100))
    return Needs(
        room=QSize(width, height), spec=spec, places=PLACES, least=least, tab_px=20, gap_px=5
    )


@pytest.mark.parametrize(
    ("size", "columns", "foot"),
    [
        # There is room for all; the last column is too low; all are too low for what is below.
        ((310, 310), [["left"], ["mid"], ["right", "under"]], ("foot",)),
        ((310, 309), [["left"], ["mid"], ["right under"]], ("foot",)),
        ((310, 224), [["left"], ["mid foot"], ["right", "under"]], ()),
        # Columns that are too narrow yield in their order.
        ((309, 900), [["left"], ["mid right under"]], ("foot",)),
        ((150, 900), [["mid right under left"]], ("foot",)),
    ],
)
def test_panels_without_room_of_their_own_are_tabs(size, columns, foot):
    fold = folded(COLUMNS, ("foot",), needs(*size))
    assert [[" ".join(tabs) for tabs in column] for column in fold.columns] == columns
    assert fold.foot == foot


def test_gaps_between_panels_are_no_room_of_theirs():
    needed = needs(400, 310)
    widths, (height, below), heights = room_of(folded(COLUMNS, ("foot",), needed), needed)
    assert sum(widths) + 2 * 5 in (399, 400)
    assert height + below + 5 in (309, 310)
    assert sum(heights[2]) + 5 <= height
