"""Labels and buttons that adapt to their room, and pictures that are kept."""

import pytest
from PySide6.QtCore import QEvent, QPoint, QRectF, QTimer
from PySide6.QtGui import QColor, QHelpEvent, QImage, QPainter
from PySide6.QtWidgets import QApplication, QScrollArea, QToolButton, QToolTip, QWidget

from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.plots.signal_view import SignalView
from skinsource_gui.qt.frames import CachedPicture
from skinsource_gui.qt.labels import FittingLabel
from skinsource_gui.qt.overlays import Staleness
from skinsource_gui.qt.questions import ask_name
from skinsource_gui.qt.theme import scaled


def test_a_fitting_label_shows_the_longest_phrase_that_fits_or_dots(qtbot):
    label = FittingLabel()
    qtbot.addWidget(label)
    label.show_phrases(("a rather long phrasing of it", "a short one", "short"))
    label.resize(label.sizeHint().width(), 20)
    label.show()
    assert label.text() == "a rather long phrasing of it"
    label.resize(label.sizeHint().width() - 3, 20)
    assert label.text() == "a short one"
    label.resize(label.minimumSizeHint().width(), 20)
    assert label.text() == "short"
    label.resize(label.minimumSizeHint().width() - 8, 20)
    assert label.text().endswith("…")
    assert label.fontMetrics().horizontalAdvance(label.text()) <= label.width()


def test_a_dialog_with_a_short_question_is_as_wide_as_its_title(qapp):
    def look():
        box = QApplication.activeModalWidget()
        widths.append(box.width() - box.fontMetrics().horizontalAdvance(box.windowTitle()))
        box.reject()

    widths, parent = [], QWidget()
    for title in ("Rename snapshot 1", "Rename snapshot " + "1" * 40):
        # Before and after what widens it.
        QTimer.singleShot(0, lambda: QTimer.singleShot(0, look))
        assert ask_name(parent, title, "a", 100) is None
    assert min(widths) > 80


@pytest.mark.parametrize(("width", "begin"), [(100, "Fingertip voice coil"), (400, "Actuator")])
def test_the_tooltip_of_a_choice_begins_with_what_is_cut_off(qtbot, width, begin):
    options = (("a", "Fingertip voice coil, in air"),)
    field = ChoiceField(ChoiceSpec(label="Actuator", options=options, hint="What moves the skin"))
    qtbot.addWidget(field)
    field.setFixedWidth(width)
    field.show()
    qtbot.waitUntil(lambda: not field.grab().isNull())
    QApplication.sendEvent(field, QHelpEvent(QEvent.Type.ToolTip, QPoint(5, 5), QPoint(5, 5)))
    assert QToolTip.text().startswith(begin)
    assert QToolTip.text().endswith("What moves the skin")
    QToolTip.hideText()


def test_only_what_is_stale_for_a_while_is_called_so_and_it_ends_at_once(qapp, qtbot):
    staleness, other, changes = Staleness(qapp), Staleness(qapp), []
    staleness.changed.connect(changes.append)
    staleness.set_stale(True)
    staleness.set_stale(False)
    other.set_stale(True)
    qtbot.waitUntil(lambda: other.is_stale)
    assert changes == []
    staleness.set_stale(True)
    qtbot.waitUntil(lambda: staleness.is_stale)
    for stale in (True, False, False):
        staleness.set_stale(stale)
    assert changes == [True, False]
    for each in (staleness, other):
        each.deleteLater()


ROOM = QRectF(2, 3, 8, 6)


def sheet(ratio=1.0):
    image = QImage(12 * int(ratio), 12 * int(ratio), QImage.Format.Format_RGB32)
    image.setDevicePixelRatio(ratio)
    image.fill(QColor("white"))
    return image


class Dot:
    """Paints a square and counts how often."""

    def __init__(self, colour="red"):
        self.colour, self.times = colour, 0

    def paint(self, painter):
        self.times += 1
        painter.fillRect(QRectF(4, 4, 2, 2), QColor(self.colour))


def show(cached, dot, key=(), ground=None, ratio=1.0, room=ROOM):
    image = sheet(ratio)
    painter = QPainter(image)
    cached.paint(painter, room, key, dot.paint, ground)
    painter.end()
    return image


@pytest.mark.parametrize("ratio", [1.0, 2.0])
@pytest.mark.parametrize("room", [ROOM, QRectF(0, 0, 12, 12), QRectF(8, 8, 4, 4)])
def test_a_kept_picture_looks_as_if_painted_and_is_painted_anew_only_for_another_key(
    qapp, room, ratio
):
    direct, cached, dot = sheet(ratio), CachedPicture(), Dot()
    painter = QPainter(direct)
    painter.setClipRect(room)
    Dot().paint(painter)
    painter.end()
    for key, times in (("light", 1), ("light", 1), ("dark", 2)):
        assert show(cached, dot, (key, 1.5), room=room, ratio=ratio) == direct
        assert dot.times == times


@pytest.fixture
def view(qtbot):
    """A plot in a dock, with large letters."""
    area, view = QScrollArea(), SignalView("plot", "Plot")
    qtbot.addWidget(area)
    area.setWidgetResizable(True)
    area.setWidget(view)
    view.setFont(scaled(view.font(), 2.0))
    for name in ("Remove 52 ms delay", "Each to its peak"):
        view.toolbar.add_switch(name, name, name, lambda on: None)
    view.toolbar.show_state(layout="overlaid", zoomed=False)
    area.show()
    yield view
    area.hide()


def shown(view):
    buttons = view.toolbar.findChildren(QToolButton)
    return [button for button in buttons if button.isVisibleTo(view)]


def places(view):
    return {button.objectName(): button.geometry() for button in shown(view)}


def settle(view, width, height=700):
    view.window().resize(width, height)
    for _ in range(5):
        QApplication.processEvents()


@pytest.mark.parametrize("share", [1.1, 0.7, 0.4])
def test_buttons_take_more_rows_where_words_have_no_room(view, share):
    settle(view, round(share * view.toolbar.sizeHint().width()))
    assert (len({button.geometry().y() for button in shown(view)}) == 1) == (share > 1.0)
    for button in shown(view):
        assert view.toolbar.rect().contains(button.geometry())
        assert button.width() >= button.sizeHint().width()


def test_in_any_room_they_settle_and_the_way_out_of_a_zoom_moves_none(view):
    for width in (*range(300, 1200, 47), *range(1200, 300, -59)):
        settle(view, width)
        before = places(view)
        view.toolbar.show_state(layout="overlaid", zoomed=True)
        settle(view, width)
        assert places(view).items() > before.items()
        view.toolbar.show_state(layout="overlaid", zoomed=False)
        settle(view, width)
        assert places(view) == before
