from functools import partial
from itertools import product

import pytest
from PySide6.QtCore import QMargins, QPoint, QRect, QSize, Qt, QTimer
from PySide6.QtGui import QFontMetrics, QTextDocument
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QToolBar, QToolButton, QWidget

from skinsource.design import edits
from skinsource.engine.gains import TraceError
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.fields.units import minus
from skinsource_gui.panels.inspector.panel import InputHeading
from skinsource_gui.plots.legend import LegendStrip
from skinsource_gui.qt.screen_fit import ScreenFit, fitted
from skinsource_gui.shell.limb_note import LimbNote
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import start_design

FRAMES = [QMargins(1, 24, 1, 5), QMargins(8, 31, 8, 8), QMargins(0, 37, 0, 0)]
#: Screens in logical pixels: 1366x768, 1080p at scale 1, 1.5 and 2.
SCREENS = [QRect(0, 0, 1366, 768), QRect(0, 0, 1920, 1080), QRect(0, 0, 1280, 720)]
NAMES = ("frequency_hz", "amplitude")
SMALLEST = QRect(0, 0, 960, 540)


@pytest.mark.parametrize("frame", FRAMES)
@pytest.mark.parametrize("screen", [*SCREENS, SMALLEST])
@pytest.mark.parametrize("place", [QRect(0, 0, 1600, 940), QRect(900, 500, 700, 400)])
def test_window_and_frame_lie_on_the_screen(frame, screen, place):
    inside = fitted(place, screen, frame)
    assert screen.contains(inside.marginsAdded(frame))
    room = screen.marginsRemoved(frame)
    assert inside.size() == place.size().boundedTo(room.size())


def test_a_window_that_fits_is_left_where_it_is():
    place = QRect(100, 100, 800, 500)
    assert fitted(place, SCREENS[0], FRAMES[0]) == place


def test_a_window_too_large_for_its_screen_is_fitted_onto_it_before_it_is_shown(qtbot):
    window = QWidget()
    qtbot.addWidget(window)
    window.resize(5000, 4000)
    ScreenFit(window).guess()
    room = window.screen().availableGeometry()
    assert room.contains(window.geometry())
    # There is room left for a frame, the widest part of which is above.
    assert window.geometry().top() > room.top()
    assert window.geometry().height() < room.height()


@pytest.mark.parametrize("arrangement", ["design", "analysis", "presentation"])
def test_the_studio_is_small_enough_for_1080p_at_scale_2(window, settle, arrangement):
    large = window.size()
    window.do(f"arrange_{arrangement}")
    for frame in FRAMES:
        window.resize(large)
        room = SMALLEST.marginsRemoved(frame).size()
        window.resize(room)
        settle()
        assert window.size() == room
        # Its status bar is seen, too.
        assert window.statusBar().geometry().bottom() < room.height()


def test_where_there_is_room_no_panel_scrolls(window, settle):
    for size in (QSize(1366, 728), QSize(1920, 1040)):
        window.resize(size)
        for arrangement in ("design", "analysis", "presentation"):
            window.do(f"arrange_{arrangement}")
            settle()
            for name, dock in window.docks.items():
                if dock.isVisible():
                    bars = dock.widget().verticalScrollBar(), dock.widget().horizontalScrollBar()
                    assert not any(bar.isVisible() for bar in bars), (name, arrangement, size)


def test_text_grows_everywhere_and_comes_back(window, settle, preferences):
    label = window.setup_bar._titles[0]
    before, field = label.fontMetrics().height(), window.setup_bar._limb.height()
    for _ in range(4):
        window.do("enlarge_text")
    settle()
    assert label.fontMetrics().height() > 1.3 * before
    assert window.setup_bar._limb.height() > field
    assert preferences.text_scale == pytest.approx(1.1**4)
    window.do("reset_text")
    settle()
    assert label.fontMetrics().height() == before


def test_rows_and_plots_have_room_for_large_words(window, settle):
    inputs = window.panel("timeline")
    row = inputs._rows.rows[0]
    buttons = [
        button
        for button in window.findChildren(QToolButton)
        if button.isVisible() and button.text()
    ]
    usual = row.height()
    window.document.apply(edits.move_inputs(window.document.design, window.document.view, (1,), 3))
    for _ in range(5):
        window.do("enlarge_text")
    settle()
    line = row.fontMetrics().height()
    assert row.height() >= 2 * line
    assert row.height() > usual
    assert row._places.name.height() >= line
    assert row._places.amplitude.top() >= row._places.name.bottom()
    assert row.amplitude.height() >= line
    heading = window.panel("inspector").findChild(InputHeading)._title
    assert heading.fontMetrics().horizontalAdvance(heading.text()) <= heading.width()
    for button in buttons:
        assert button.height() >= button.fontMetrics().height() + 6, button.text()
    for legend in window.findChildren(LegendStrip):
        assert legend.height() >= QFontMetrics(legend.text_font).height() > 14
    window.do("reset_text")
    settle()
    assert row.height() == usual


def test_presenting_shows_frequency_and_amplitude_in_large_words(window, settle):
    panel = window.panel("frequency_and_amplitude")
    assert not panel.isVisible()
    small = window.panel("hand").fontMetrics().height()
    window.do("arrange_presentation")
    settle()
    assert window.panel("hand").fontMetrics().height() > 1.15 * small
    fields = {name: panel.findChild(QWidget, f"{name}_field") for name in NAMES}
    assert all(field.isVisible() for field in fields.values())
    fields["frequency_hz"].edited.emit(250.0, None)
    fields["amplitude"].edited.emit(0.5, None)
    track = window.document.design.inputs[0]
    assert (track.clips[0].waveform.frequency_hz, track.amplitude) == (250.0, 0.5)
    window.do("arrange_design")
    settle()
    assert window.panel("hand").fontMetrics().height() == small


def test_a_window_that_was_presenting_starts_with_large_words(make_window, preferences, qapp):
    usual = make_window()
    size = qapp.font().pointSizeF()
    usual.do("arrange_presentation")
    large = qapp.font().pointSizeF()
    assert large > size
    usual.close()
    preferences.flush()
    again = MainWindow(
        start_design("synthetic-1"), preferences=preferences, available_limbs=("synthetic-1",)
    )
    assert qapp.font().pointSizeF() == large
    assert again.docks["frequency_and_amplitude"].isHidden() is False
    again.do("arrange_design")
    assert qapp.font().pointSizeF() == size
    again.close_unasked()


@pytest.mark.parametrize("enlarged", [0, 3])
def test_the_status_bar_says_less_where_there_is_less_room_and_cuts_nothing(
    window, settle, enlarged
):
    for _ in range(enlarged):
        window.do("enlarge_text")
    for width in (600, 700, 820, 960, 1366):
        window.resize(width, 500)
        window.document.edit("a", window.document.design.with_input(0, amplitude=width / 1e3))
        settle()
        _check_status_bar(window)
    window.do("reset_text")


def _check_status_bar(window):
    line = window.status_line
    line.show_error(TraceError(estimate=2e-15, bound=3e-13))
    QApplication.processEvents()
    for label in (line.error, line.findChild(QLabel, "work")):
        width_px = label.fontMetrics().horizontalAdvance(label.text())
        assert width_px <= label.width(), label.text()
    note = window.findChild(LimbNote)
    document = QTextDocument()
    document.setDefaultFont(note.font())
    document.setDocumentMargin(0)
    document.setHtml(note.text())
    assert document.idealWidth() <= note.width() + 1
    assert "SYNTHETIC LIMB" in note.text()
    # The way to the measured limbs is never lost.
    assert "href" in note.text()
    right = note.mapTo(window, QPoint(note.width(), 0)).x()
    assert right <= window.width()


def shown_whole(field):
    """How much of what a choice wants it has."""
    return field.width() / field.sizeHint().width()


def test_a_narrow_bar_keeps_its_actions_in_a_menu_and_its_choices_to_be_read(
    window, preferences, settle
):
    bar = window.findChild(QToolBar, "setup")
    fold, choices = bar.actions_at_end, window.setup_bar.findChildren(ChoiceField)
    names = ("undo", "redo", "find_action")
    for scale, least in ((1.0, 0.7), (1.5, 0.4)):
        preferences.text_scale = scale
        window.appearance.apply()
        window.resize(800, 600)
        settle()
        assert fold.more.isVisible()
        assert not bar.findChild(QToolButton, "qt_toolbar_ext_button").isVisible()
        assert min(map(shown_whole, choices)) > least
        parts = (*choices, window.playback.bar, fold.more)
        assert all(part.visibleRegion().boundingRect() == part.rect() for part in parts)
        actions = [action for action in fold.more.menu().actions() if not action.isSeparator()]
        assert actions == [window.actions_by_name[name] for name in names]
    window.do("reset_text")
    window.resize(1366, 728)
    settle()
    assert not fold.more.isVisible()
    buttons = [
        button.defaultAction() for button in fold.findChildren(QToolButton) if button.isVisible()
    ]
    assert buttons == [window.actions_by_name[name] for name in names]


def test_the_menu_of_a_narrow_bar_opens_by_mouse_and_by_keyboard(window, settle, qtbot):
    window.resize(800, 600)
    settle()
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    more = window.findChild(QToolBar, "setup").actions_at_end.more
    window.playback.bar.gain.setFocus()
    QTest.keyClick(window.playback.bar.gain, Qt.Key.Key_Tab)
    assert QApplication.focusWidget() is more
    opened = []
    for act in (
        partial(QTest.mouseClick, more, Qt.MouseButton.LeftButton),
        partial(QTest.keyClick, more, Qt.Key.Key_Space),
    ):
        # The menu keeps the loop: who waits for it closes it.
        QTimer.singleShot(50, lambda: opened.append(close_menu(more.menu())))
        act()
    qtbot.waitUntil(lambda: len(opened) == 2, timeout=5000)
    assert opened == [True, True]


def close_menu(menu):
    was = menu.isVisible()
    menu.close()
    return was


def test_each_number_of_the_bar_is_shown_whole_in_letters_of_any_size(window, preferences, qtbot):
    fields = window.findChild(QToolBar, "setup").findChildren(NumberField)

    def in_sight():
        return all(field.visibleRegion().boundingRect() == field.rect() for field in fields)

    assert fields
    for arrangement in ("design", "presentation"):
        window.do(f"arrange_{arrangement}")
        for scale, width in product((1.0, 1.5, 2.0, 3.0), (800, 1366)):
            preferences.text_scale = scale
            window.appearance.apply()
            window.resize(width, 600)
            qtbot.waitUntil(in_sight, timeout=5000)
            for field in fields:
                low, high = field.spec.minimum, field.spec.maximum
                for value in (low, low + 0.01, -0.01, high - 0.01, high):
                    field.edited.emit(value, None)
                    whole = minus(f"{value:.2f}".rstrip("0").rstrip("."))
                    assert field.text() == whole, (arrangement, scale, width)
    window.do("reset_text")
