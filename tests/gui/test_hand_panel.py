"""The hand panel, driven by real mouse and key events."""

from itertools import combinations

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt, QTimer
from PySide6.QtGui import QAction, QContextMenuEvent, QHelpEvent, QKeyEvent, QShortcut
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit, QMenu, QToolTip, QVBoxLayout, QWidget

from skinsource.design import MAX_INPUTS, Design, Input
from skinsource.locations import input_place
from skinsource.view import View
from skinsource.waveforms import Noise, Tone
from skinsource_gui.panels.hand import HandPanel
from skinsource_gui.theme import DARK, LIGHT, Theme
from skinsource_gui.widgets.site_marker import contrast, readable_on

KEY, LEFT = Qt.Key, Qt.MouseButton.LeftButton
NONE, SHIFT = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier
CONTROL = Qt.KeyboardModifier.ControlModifier

# What popups do on a screen.
pytestmark = pytest.mark.qt_log_ignore(
    "This plugin does not support raise",
    "This plugin does not support grabbing the keyboard",
    extend=True,
)


class Studio:
    """A panel whose wishes come true, and what it wished."""

    def __init__(self, panel: HandPanel) -> None:
        self.panel = panel
        self.diagram = panel.diagram
        self.design = Design(limb="synthetic-1")
        self.view = View(selected_input=None)
        self.edits: list[tuple[str, Design, int | None]] = []
        self.order: list[str] = []
        panel.design_edited.connect(self._edit)
        panel.view_changed.connect(self._look)

    def show(self, *inputs: Input, selected: int | None = None) -> None:
        self.design = Design(limb="synthetic-1")
        for one in inputs:
            self.design = self.design.adding(one)
        self.view = View(selected_input=selected)
        self.panel.show_state(self.design, self.view)

    def _edit(self, label: str, design: Design, gesture: int | None) -> None:
        self.edits.append((label, design, gesture))
        self.order.append("design")
        self.design = design
        self.panel.show_state(design, self.view)

    def _look(self, view: View) -> None:
        self.order.append("view")
        self.view = view
        self.panel.show_state(self.design, view)

    @property
    def sites(self) -> list[int]:
        return [one.location for one in self.design.inputs]

    def click(self, site: int, modifier: Qt.KeyboardModifier = NONE) -> None:
        QTest.mouseClick(self.diagram, LEFT, modifier, self.diagram.site_centre(site))

    def press(self, site: int) -> None:
        QTest.mousePress(self.diagram, LEFT, NONE, self.diagram.site_centre(site))

    def drag_to(self, point: QPoint) -> None:
        QTest.mouseMove(self.diagram, point)

    def release(self, point: QPoint) -> None:
        QTest.mouseRelease(self.diagram, LEFT, NONE, point)

    def keys(self, *keys: Qt.Key, modifier: Qt.KeyboardModifier = NONE) -> None:
        for key in keys:
            QTest.keyClick(self.diagram, key, modifier)

    def menu(self, site: int, reason: QContextMenuEvent.Reason) -> dict[str, QAction]:
        point = self.diagram.site_centre(site)
        event = QContextMenuEvent(reason, point, self.diagram.mapToGlobal(point))
        QApplication.sendEvent(self.diagram, event)
        menus = self.panel.findChildren(QMenu, "hand_menu")
        assert len(menus) == 1
        return {a.text().split("\t")[0]: a for a in menus[0].actions() if a.text()}

    def close_menu(self) -> None:
        for menu in self.panel.findChildren(QMenu, "hand_menu"):
            menu.close()
        QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


@pytest.fixture
def studio(qtbot) -> Studio:
    panel = HandPanel()
    qtbot.addWidget(panel)
    panel.resize(260, 330)
    with qtbot.waitExposed(panel):
        panel.show()
    studio = Studio(panel)
    studio.show()
    return studio


# Placing and selecting


@pytest.mark.parametrize("site", range(1, 21))
def test_a_click_on_an_empty_site_places_an_input_there_and_selects_it(studio, site):
    studio.click(site)
    assert studio.sites == [site]
    assert studio.view.selected_input == 0
    assert studio.order == ["design", "view"]
    assert studio.edits[0][0].startswith(f"Place input at {site} (")


def test_sites_are_far_enough_apart_to_be_hit_at_the_smallest_size(studio):
    points = [studio.diagram.site_centre(site) for site in range(1, 21)]
    for one, other in combinations(points, 2):
        apart = one - other
        assert apart.x() ** 2 + apart.y() ** 2 >= 22**2
    for site, point in enumerate(points, start=1):
        for off in (QPoint(0, 11), QPoint(0, -11), QPoint(11, 0), QPoint(-11, 0)):
            assert studio.diagram.hand.site_at(QPointF(point + off)) == site
            assert studio.diagram.rect().contains(point + off)


def test_a_click_beside_the_sites_does_nothing(studio):
    QTest.mouseClick(studio.diagram, LEFT, NONE, QPoint(2, 2))
    assert studio.edits == []


def test_a_new_input_copies_waveform_and_amplitude_of_the_selected_one(studio):
    first = Input(location=7, waveform=Tone(frequency_hz=60.0))
    second = Input(location=8, waveform=Noise(), amplitude=0.25, onset_s=0.5, muted=True)
    studio.show(first, second, selected=1)
    studio.click(18)
    new = studio.design.inputs[2]
    assert (new.waveform, new.amplitude) == (second.waveform, 0.25)
    assert (new.onset_s, new.muted, new.colour) == (0.0, False, 2)


def test_a_new_input_is_plain_where_none_is_selected(studio):
    studio.show(Input(location=8, waveform=Noise(), amplitude=0.25))
    studio.click(18)
    assert studio.design.inputs[1].waveform == Input(location=18).waveform
    assert studio.design.inputs[1].amplitude == Input(location=18).amplitude


def test_a_click_on_an_input_selects_it_and_edits_nothing(studio):
    studio.show(Input(location=7), Input(location=3), selected=0)
    studio.click(3)
    assert studio.view.selected_input == 1
    assert studio.edits == []


def test_repeated_clicks_cycle_through_the_inputs_of_a_site(studio):
    studio.show(Input(location=7), Input(location=3), Input(location=3), Input(location=3))
    seen = []
    for _ in range(5):
        studio.click(3)
        seen.append(studio.view.selected_input)
    assert seen == [3, 1, 2, 3, 1]
    assert studio.edits == []


@pytest.mark.parametrize("modifier", [SHIFT, CONTROL])
def test_a_click_with_shift_or_control_adds_a_further_input(studio, modifier):
    studio.show(Input(location=3), selected=0)
    studio.click(3, modifier)
    assert studio.sites == [3, 3]
    assert studio.view.selected_input == 1


def test_a_full_design_says_so_and_takes_no_more(studio):
    studio.show(*[Input(location=3)] * MAX_INPUTS)
    studio.click(7)
    assert studio.edits == []
    assert str(MAX_INPUTS) in studio.diagram.state.note


# Dragging


def test_a_drag_moves_the_input_live_in_one_gesture(studio):
    studio.show(Input(location=7), Input(location=18), selected=0)
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(16))
    assert studio.sites == [7, 16]
    assert studio.diagram.state.moving == 1
    studio.drag_to(studio.diagram.site_centre(13))
    assert studio.sites == [7, 13]
    studio.release(studio.diagram.site_centre(13))
    assert studio.diagram.state.moving is None
    assert studio.view.selected_input == 1
    assert [label for label, _, _ in studio.edits] == [
        f"Move input to 16 ({_short(16)})",
        f"Move input to 13 ({_short(13)})",
    ]
    gestures = {gesture for _, _, gesture in studio.edits}
    assert len(gestures) == 1
    assert None not in gestures


def test_two_drags_are_two_gestures(studio):
    studio.show(Input(location=18), selected=0)
    for start, end in ((18, 13), (13, 8)):
        studio.press(start)
        studio.drag_to(studio.diagram.site_centre(end))
        studio.release(studio.diagram.site_centre(end))
    assert studio.sites == [8]
    assert studio.edits[0][2] != studio.edits[-1][2]


def test_escape_during_a_drag_restores_the_design(studio):
    studio.show(Input(location=18), selected=0)
    before = studio.design
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(13))
    studio.keys(KEY.Key_Escape)
    assert studio.design == before
    studio.drag_to(studio.diagram.site_centre(8))
    studio.release(studio.diagram.site_centre(8))
    assert studio.design == before
    assert len({gesture for _, _, gesture in studio.edits}) == 1


def test_dropping_away_from_every_site_restores_the_design(studio):
    studio.show(Input(location=18), selected=0)
    before = studio.design
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(13))
    assert studio.design != before
    studio.drag_to(QPoint(4, 300))
    studio.release(QPoint(4, 300))
    assert studio.design == before
    assert studio.diagram.state.ghost is None


def test_hiding_the_panel_during_a_drag_restores_the_design(studio):
    studio.show(Input(location=18), selected=0)
    before = studio.design
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(13))
    studio.panel.hide()
    assert studio.design == before


def test_a_drag_ends_when_its_input_is_taken_away(studio):
    studio.show(Input(location=18), selected=0)
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(13))
    studio.show()
    edits = len(studio.edits)
    studio.drag_to(studio.diagram.site_centre(8))
    studio.release(studio.diagram.site_centre(8))
    assert len(studio.edits) == edits
    assert studio.diagram.state.moving is None


def test_a_shaky_click_is_no_drag(studio):
    studio.show(Input(location=18), selected=0)
    point = studio.diagram.site_centre(18)
    studio.press(18)
    studio.drag_to(point + QPoint(2, 2))
    studio.release(point + QPoint(2, 2))
    assert studio.edits == []


# Removing, muting


@pytest.mark.parametrize("key", [KEY.Key_Delete, KEY.Key_Backspace])
@pytest.mark.parametrize(
    ("selected", "left", "then"), [(0, [8, 9], 0), (1, [7, 9], 1), (2, [7, 8], 1)]
)
def test_delete_removes_the_selected_input_and_selects_a_neighbour(
    studio, key, selected, left, then
):
    studio.show(*(Input(location=site) for site in (7, 8, 9)), selected=selected)
    studio.keys(key)
    assert studio.sites == left
    assert studio.view.selected_input == then
    assert len(studio.edits) == 1


def test_removing_the_last_input_selects_none(studio):
    studio.show(Input(location=7), selected=0)
    studio.keys(KEY.Key_Delete)
    assert studio.sites == []
    assert studio.view.selected_input is None


def test_the_selection_names_an_existing_input_at_every_moment(studio):
    def check(*_):
        index = studio.view.selected_input
        assert index is None or index < len(studio.design.inputs)

    studio.panel.design_edited.connect(check)
    studio.panel.view_changed.connect(check)
    studio.show(Input(location=7), Input(location=8), selected=1)
    studio.keys(KEY.Key_Delete, KEY.Key_Delete)
    assert studio.order == ["view", "design", "view", "design"]


@pytest.mark.parametrize(
    "reason", [QContextMenuEvent.Reason.Mouse, QContextMenuEvent.Reason.Keyboard]
)
def test_the_menu_of_a_site_selects_mutes_solos_removes_and_adds(studio, reason):
    studio.show(Input(location=7), Input(location=3), selected=0)
    studio.keys(KEY.Key_3)
    actions = studio.menu(3, reason)
    assert studio.view.selected_input == 1
    actions["Mute"].trigger()
    assert studio.design.inputs[1].muted
    assert studio.diagram.state.marks[1].silent
    studio.close_menu()
    actions = studio.menu(3, reason)
    assert actions["Mute"].isChecked()
    actions["Mute"].trigger()
    actions["Solo"].trigger()
    assert (studio.design.inputs[1].muted, studio.design.inputs[1].solo) == (False, True)
    assert studio.diagram.state.marks[0].silent
    actions["Add input here"].trigger()
    assert studio.sites == [7, 3, 3]
    studio.close_menu()
    studio.menu(3, reason)["Remove"].trigger()
    assert studio.sites == [7, 3]
    studio.close_menu()


def test_the_menu_of_an_empty_site_only_adds(studio):
    actions = studio.menu(12, QContextMenuEvent.Reason.Mouse)
    assert [words for words, action in actions.items() if action.isEnabled()] == ["Add input here"]
    actions["Add input here"].trigger()
    assert studio.sites == [12]
    studio.close_menu()


# Keyboard


def test_tab_reaches_the_diagram_and_shows_the_cursor_on_the_selected_input(qtbot):
    window = QWidget()
    qtbot.addWidget(window)
    field, panel = QLineEdit(), HandPanel()
    layout = QVBoxLayout(window)
    layout.addWidget(field)
    layout.addWidget(panel)
    panel.show_state(
        Design(limb="synthetic-1", inputs=(Input(location=13),)), View(selected_input=0)
    )
    with qtbot.waitActive(window):
        window.show()
        window.activateWindow()
    field.setFocus()
    assert panel.diagram.state.cursor is None
    QTest.keyClick(field, KEY.Key_Tab)
    assert panel.diagram.hasFocus()
    assert panel.diagram.state.cursor == 13
    QTest.keyClick(panel.diagram, KEY.Key_Backtab)
    assert field.hasFocus()
    assert panel.diagram.state.cursor is None


def test_arrow_keys_reach_every_site_from_every_site(studio):
    hand = studio.diagram.hand
    for start in range(1, 21):
        reached, waiting = {start}, [start]
        while waiting:
            site = waiting.pop()
            for way in ((1, 0), (-1, 0), (0, 1), (0, -1)):
                beside = hand.neighbour(site, way)
                if beside not in reached:
                    reached.add(beside)
                    waiting.append(beside)
        assert reached == set(range(1, 21)), f"from {start}"


def test_arrow_keys_go_the_way_they_point(studio):
    studio.keys(KEY.Key_8)
    for key, expected in (
        (KEY.Key_Up, 3),
        (KEY.Key_Right, 2),
        (KEY.Key_Down, 7),
        (KEY.Key_Left, 8),
        (KEY.Key_Down, 13),
        (KEY.Key_Down, 16),
    ):
        studio.keys(key)
        assert studio.diagram.cursor_site == expected
    assert studio.diagram.state.cursor == 16
    assert studio.edits == []


def test_home_end_and_typed_numbers_move_the_cursor(studio):
    studio.keys(KEY.Key_End)
    assert studio.diagram.cursor_site == 20
    studio.keys(KEY.Key_Home)
    assert studio.diagram.cursor_site == 1
    studio.keys(KEY.Key_1, KEY.Key_7)
    assert studio.diagram.cursor_site == 17
    studio.keys(KEY.Key_4)
    assert studio.diagram.cursor_site == 4
    pause = studio.diagram.findChild(QTimer, "typing")
    assert pause.interval() == 800
    studio.keys(KEY.Key_1)
    pause.timeout.emit()
    studio.keys(KEY.Key_5)
    assert studio.diagram.cursor_site == 5


@pytest.mark.parametrize("key", [KEY.Key_Return, KEY.Key_Enter, KEY.Key_Space])
def test_enter_and_space_place_and_then_select(studio, key):
    studio.show(Input(location=7), selected=0)
    studio.keys(KEY.Key_1, KEY.Key_2, key)
    assert studio.sites == [7, 12]
    assert studio.view.selected_input == 1
    studio.keys(KEY.Key_7, key)
    assert studio.view.selected_input == 0
    assert studio.sites == [7, 12]


@pytest.mark.parametrize(
    ("key", "modifier"),
    [(KEY.Key_Insert, NONE), (KEY.Key_Plus, NONE), (KEY.Key_Plus, SHIFT), (KEY.Key_Return, SHIFT)],
)
def test_a_further_input_can_be_added_by_keyboard(studio, key, modifier):
    studio.show(Input(location=7), selected=0)
    studio.keys(KEY.Key_7)
    studio.keys(key, modifier=modifier)
    assert studio.sites == [7, 7]


def test_shift_and_arrows_move_the_selected_input_in_one_gesture_per_hold(studio):
    studio.show(Input(location=18), Input(location=8), selected=1)
    QTest.keyPress(studio.diagram, KEY.Key_Shift)
    for _ in range(2):
        event = QKeyEvent(QEvent.Type.KeyPress, KEY.Key_Down, SHIFT)
        QApplication.sendEvent(studio.diagram, event)
    QTest.keyRelease(studio.diagram, KEY.Key_Shift)
    assert studio.sites == [18, 16]
    assert studio.diagram.cursor_site == 16
    studio.keys(KEY.Key_Up, modifier=SHIFT)
    assert studio.sites == [18, 13]
    first, second, third = (gesture for _, _, gesture in studio.edits)
    assert first == second != third


def test_keys_with_control_are_left_to_the_window(studio):
    for key in (KEY.Key_1, KEY.Key_Delete, KEY.Key_Left, KEY.Key_Plus):
        event = QKeyEvent(QEvent.Type.KeyPress, key, CONTROL)
        QApplication.sendEvent(studio.diagram, event)
        assert not event.isAccepted()
    assert studio.edits == []


def test_space_is_left_to_the_window_until_keys_are_used_here(studio, qtbot):
    played = []
    shortcut = QShortcut(Qt.Key.Key_Space, studio.panel)
    shortcut.activated.connect(lambda: played.append(True))
    with qtbot.waitActive(studio.panel):
        studio.panel.activateWindow()
    studio.click(18)
    QTest.keyClick(studio.panel.windowHandle(), KEY.Key_Space)
    assert played == [True]
    studio.keys(KEY.Key_8)
    QTest.keyClick(studio.panel.windowHandle(), KEY.Key_Space)
    assert played == [True]
    assert studio.sites == [18, 8]


# Showing


def test_an_input_has_its_own_colour_on_the_hand_in_both_themes(studio):
    studio.show(Input(location=20), Input(location=16), selected=1)
    for theme in (LIGHT, DARK):
        studio.panel.show_theme(theme)
        image = studio.diagram.grab().toImage()
        for index, site in enumerate((20, 16)):
            point = studio.diagram.site_centre(site) + QPoint(0, 8)
            assert image.pixelColor(point).name() == theme.inputs[index]


def test_a_silent_input_is_hollow(studio):
    studio.show(Input(location=20, muted=True))
    image = studio.diagram.grab().toImage()
    point = studio.diagram.site_centre(20)
    assert image.pixelColor(point + QPoint(0, 7)).name() != LIGHT.inputs[0]


def test_sites_of_both_contacts_differ_in_shape(studio):
    hand = studio.diagram.hand
    assert [site for site in range(1, 21) if hand.push(site) is not None] == [1, 2, 3, 4, 5]


@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=lambda theme: theme.name)
def test_numbers_are_readable_on_every_input_colour(theme: Theme):
    for number in range(len(theme.inputs)):
        colour = theme.input_colour(number)
        assert contrast(readable_on(colour), colour) >= 4.5


def test_the_tooltip_names_place_contact_and_inputs(studio):
    studio.show(Input(location=2, muted=True), selected=0)
    point = studio.diagram.site_centre(2)
    event = QHelpEvent(QEvent.Type.ToolTip, point, studio.diagram.mapToGlobal(point))
    QApplication.sendEvent(studio.diagram, event)
    words = QToolTip.text()
    for expected in ("2 ·", "Digit II, tip", "in-axis", "Tone, muted, selected"):
        assert expected in words
    QToolTip.hideText()


def test_the_cursor_is_announced(studio):
    studio.show(Input(location=7))
    studio.keys(KEY.Key_7)
    words = studio.diagram.accessibleDescription()
    assert words.startswith("Place 7 · Digit II, pad. perpendicular")
    assert "Input 1: Tone" in words
    assert studio.diagram.accessibleName()


def test_a_selection_that_the_design_has_lost_is_not_shown(studio):
    studio.show(Input(location=7), selected=4)
    assert studio.diagram.state.selected is None


def test_the_panel_needs_nothing_computed(studio):
    assert studio.panel.needs == frozenset()


@pytest.mark.parametrize("size", [(260, 330), (260, 900), (900, 330), (700, 1200)])
def test_all_sites_stay_inside_at_every_size(studio, size):
    studio.panel.resize(*size)
    radius = round(studio.diagram.hand.radius_px)
    for site in range(1, 21):
        area = studio.diagram.hand.marker_area(site).toAlignedRect()
        assert studio.diagram.rect().contains(area.adjusted(-radius // 4, 0, radius // 4, 0))


def _short(site: int) -> str:
    return input_place(site).short_name
