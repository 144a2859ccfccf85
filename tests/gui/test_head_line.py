"""The one line above the panels: what stands in it and says it, and the list of undo steps."""

import time
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QMenu, QToolButton, QWidget

from skinsource import Design, View, track
from skinsource.design.labels import CHOICES
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.shell.actions import MENUS
from skinsource_gui.shell.bars import SetupBar, StepsMenu
from skinsource_gui.state.document import Document
from skinsource_gui.state.preferences import start_design


class Bench:
    """A document and the menu that lists its steps."""

    def __init__(self, widget):
        self.document = Document(Design(limb="synthetic-1", inputs=(track(location=7),)))
        self.menu = StepsMenu(self.document, widget)

    @property
    def amplitude(self):
        return self.document.design.inputs[0].amplitude

    def edit(self, *amplitudes, gesture=None):
        for amplitude in amplitudes:
            design = self.document.design.with_input(0, amplitude=amplitude)
            self.document.edit(f"Amplitude {amplitude:g}", design, gesture)

    def rows(self):
        """Label and time of each step, from the first one on."""
        self.menu.aboutToShow.emit()
        return [tuple(step.text().split("\t")) for step in reversed(self.menu.actions())]

    def present(self):
        return [label for label, _ in self.rows()].index(
            next(step.text().split("\t")[0] for step in self.menu.actions() if step.isChecked())
        )

    def go(self, count):
        self.rows()
        next(step for step in self.menu.actions() if step.data() == count).trigger()


@pytest.fixture
def bench(qtbot):
    widget = QWidget()
    qtbot.addWidget(widget)
    bench = Bench(widget)
    yield bench
    bench.document.undo_stack.clear()


def test_each_step_is_listed_with_its_label_and_time_and_a_gesture_once(bench):
    before = time.strftime("%H:%M:%S", time.localtime(time.time()))
    bench.edit(2.0)
    bench.edit(*range(3, 40), gesture=3)
    after = time.strftime("%H:%M:%S", time.localtime(time.time()))
    labels, times = zip(*bench.rows(), strict=True)
    assert labels == ("New design", "Amplitude 2", "Amplitude 39")
    assert times[0] == ""
    assert all(before <= when <= after for when in times[1:])
    assert bench.present() == 2


def test_a_step_that_is_chosen_is_gone_back_to_and_forth(bench):
    bench.edit(2.0, 3.0, 4.0)
    bench.go(1)
    assert bench.amplitude == 2.0
    assert bench.present() == 1
    assert len(bench.rows()) == 4
    bench.go(3)
    assert bench.amplitude == 4.0
    bench.go(0)
    assert bench.amplitude == 1.0
    assert not bench.document.modified
    bench.edit(9.0)
    assert [label for label, _ in bench.rows()] == ["New design", "Amplitude 9"]


def test_the_step_that_was_saved_is_marked_and_the_start_has_the_name_of_its_file(bench):
    bench.edit(2.0)
    bench.document.mark_saved(Path("tap.skinsource"))
    bench.edit(3.0)
    told = [when for _, when in bench.rows()]
    assert [when.endswith(", saved") for when in told] == [False, True, False]
    # The time is that of the step, so it comes first.
    assert time.strptime(told[1].split(",")[0], "%H:%M:%S")
    bench.document.start_over(bench.document.design, View(), Path("a.skinsource"))
    assert bench.rows()[0][0] == "Opened a.skinsource"
    bench.document.recover(bench.document.design, View(), None)
    assert (bench.rows()[0][0], bench.document.modified) == ("Recovered work", True)
    bench.document.start_over(bench.document.design, View(), None, scene="A & B")
    assert (bench.rows()[0][0], bench.document.modified) == ("Scene: A && B", False)


def test_a_thousand_steps_are_kept_and_older_ones_are_said_to_be_forgotten(bench):
    bench.edit(*(k / 8 for k in range(1, 1004)))
    assert len(bench.rows()) == 1001
    assert bench.rows()[0][0] == "Before the last 1000 steps"
    bench.go(1)
    assert bench.amplitude == 4 / 8


def buttons(window):
    head = window.menuWidget()
    return {
        button.objectName(): button
        for button in head.findChildren(QToolButton)
        if button.isVisible()
    }


def test_one_line_of_36_px_holds_menus_steps_transport_workspaces_limb_and_search(window, qtbot):
    window.resize(1366, 688)
    qtbot.waitUntil(lambda: window.width() == 1366)
    head = window.menuWidget()
    assert head.height() == 36
    assert window.menuBar().isVisible()
    assert window.menuBar().window() is window
    shown = buttons(window)
    assert {"undo_button", "redo_button", "play_button", "find_action_button"} <= set(shown)
    assert not shown["undo_button"].icon().isNull()
    assert (
        shown["find_action_button"].toolButtonStyle() == Qt.ToolButtonStyle.ToolButtonTextBesideIcon
    )
    assert [shown[f"arrange_{name}_button"].text() for name in ("design", "analysis")] == [
        "Compose",
        "Analyse",
    ]
    assert window.setup_bar.findChild(QWidget, "limb").shown_text == "Synthetic 1"
    assert window.docks["skin"].geometry().top() <= 40


def test_the_line_has_the_menus_and_nothing_else_that_the_palette_finds(window):
    titles = [action.text().replace("&", "") for action in window._menus.actions()]
    assert titles == list(MENUS)


def test_where_there_is_little_room_workspaces_fold_and_menus_stay(window, qtbot):
    window.resize(1366, 688)
    window.preferences.text_scale = 3.0
    window.appearance.apply()
    qtbot.waitUntil(lambda: "workspace_menu" in buttons(window))
    shown = buttons(window)
    assert "arrange_design_button" not in shown
    assert shown["workspace_menu"].text() == "Compose"
    window.do("arrange_analysis")
    assert shown["workspace_menu"].text() == "Analyse"
    bar = window.menuBar()
    qtbot.waitUntil(lambda: bar.width() == bar.sizeHint().width())
    assert all(bar.actionGeometry(menu).isValid() for menu in bar.actions())
    window.appearance.reset_text()
    QApplication.processEvents()


def test_the_steps_stand_under_the_undo_arrow_and_in_the_edit_menu(window):
    steps = window.findChild(StepsMenu)
    assert buttons(window)["undo_button"].menu() is steps
    edit = next(menu for menu in window.menuBar().findChildren(QMenu) if menu.title() == "&Edit")
    assert steps.menuAction() in edit.actions()
    window.document.edit("Louder", window.document.design.with_input(0, amplitude=2.0))
    steps.aboutToShow.emit()
    assert steps.actions()[0].text().startswith("Louder\t")


@pytest.fixture
def bar(qtbot):
    bar = SetupBar(Document(start_design("synthetic-1")))
    qtbot.addWidget(bar)
    return bar


def test_every_choice_and_every_value_of_it_is_explained_in_the_words_of_the_page(bar):
    fields = {field.accessibleName(): field for field in bar.findChildren(ChoiceField)}
    for _, label, sentence, entries in CHOICES[:1]:
        field = fields.pop(label)
        assert " ".join(field.toolTip().split()) == f"{label} {sentence}"
        for index, word in enumerate(entries):
            hint = field.itemData(index, Qt.ItemDataRole.ToolTipRole)
            assert (field.itemData(index), field.itemText(index)) == (word.name, word.title)
            assert " ".join(hint.split()) == word.sentence
    assert not fields


def test_what_the_measure_line_offers_is_found_by_its_words(bar):
    document, asked = bar._document, []
    for view, enabled in ((View(axes="xyz"), True), (View(axes="z"), False)):
        document.look(view)
        found = {action.text(): action for action in bar.choices()}
        assert found["Method: Magnitude"].isEnabled() == enabled
        for name in ("Levels: Loudest 100 ms", "Axes: x, y"):
            found[name].trigger()
            asked.append((document.view.axes, document.view.span))
    assert asked[:2] == [("xyz", "loudest"), ("xy", "loudest")]
