"""The three scenes by mouse alone."""

from pathlib import Path

from compose_checks import ENVELOPE, PATH, check_recording, check_sweep, check_train
from composer import Composer
from PySide6.QtCore import QPoint, QRegularExpression
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractItemView,
    QApplication,
    QComboBox,
    QDialogButtonBox,
    QFileDialog,
    QMessageBox,
    QWidget,
)

from skinsource_gui.panels.clip_editor.view import EditorView
from skinsource_gui.panels.timeline.lanes import LanesView

_FILES = QRegularExpression("listView|treeView")
#: A pixel of the editor is about a millisecond, and a hundredth of the level.
_HAND_S, _HAND_LEVEL = 0.004, 0.03


def train(you: Composer, _: Path) -> None:
    """Fig. 2H's wavelet train: click on the fingertip, choose the kind, sweep, equalise."""
    reset_range(you)
    hand = you.window.panel("hand").diagram
    you.click(hand, hand.site_centre(7))
    you.click(you.widget("kind_field", you.window.panel("inspector")))
    you.choose_of_popup("Wavelet train")
    you.settle()
    # Falling and rising again: the buttons do what they say.
    for order, highest_first in (
        ("Falling (sensation expands)", True),
        ("Rising (sensation contracts)", False),
    ):
        _sweep(you, order)
        frequencies_hz = you.document.design.clips[0].waveform.frequencies_hz
        you.expect(
            (frequencies_hz[0] > frequencies_hz[-1]) == highest_first,
            f"{order} frequencies: {frequencies_hz}",
        )
    you.choose("Clip", "Balance wavelets")
    you.wait(lambda: you.document.design.clips[0].waveform.gains_db, "gains are written")
    check_train(you)


def recording(you: Composer, folder: Path) -> None:
    """A recording imported, and an envelope drawn over it."""
    reset_range(you)
    you.answer(
        lambda: you.choose("File", "Import recording…"),
        QFileDialog,
        lambda dialog: _pick(you, dialog, "beat.wav"),
    )
    page = you.page()
    you.wait(lambda: page.ready, "the recording is read")
    box = page.findChild(QDialogButtonBox)
    you.click(box.button(QDialogButtonBox.StandardButton.Ok))
    you.wait(lambda: you.document.design.clips, "the recording is a clip")
    you.settle()
    lanes = you.window.panel("timeline").findChild(LanesView)
    you.click(lanes, lanes.content.boxes[0].rect.center().toPoint(), double=True)
    you.settle()
    view = you.window.panel("clip_editor").findChild(EditorView)
    you.click(you.widget("clip_envelope", you.window.panel("clip_editor")))

    def at(time_s: float, level: float) -> QPoint:
        return view.content.at(time_s, level).toPoint()

    for time_s, _level in ENVELOPE[1:]:
        you.click(view, at(time_s, 1.0))
        you.settle()
    for time_s in (ENVELOPE[0][0], ENVELOPE[-1][0]):
        you.drag(view, at(time_s, 1.0), at(time_s, 0.0))
        you.settle()
    you.picture("envelope by mouse")
    you.choose("View", "Compose workspace")
    check_recording(you, _HAND_S, _HAND_LEVEL)


def sweep(you: Composer, _: Path) -> None:
    """A sweep along the digits: places clicked on the hand of the page."""
    reset_range(you)
    you.choose("Clip", "Motion…")
    page = you.page()
    pick_of_list(you, page.findChildren(QComboBox)[0], "Sweep")
    you.settle()
    you.click(you.widget("clear_path", page))
    for place in PATH:
        you.click(page.hand, page.hand.site_centre(place))
    frequency = you.widget("part_frequency_hz_field", page)
    # The wheel turns a number only where the keyboard is.
    you.click(frequency)
    for _ in range(60):
        off = frequency.value_si - 150.0
        if abs(off) < 1e-9:
            break
        you.wheel(frequency, -1 if off > 0 else 1)
    you.click(you.widget("add_motion", page))
    you.settle()
    check_sweep(you)


def reset_range(you: Composer) -> None:
    """File > New; what is there need not be kept."""

    def discard(box: QWidget) -> None:
        you.click(box.button(QMessageBox.StandardButton.Discard))

    def new() -> None:
        you.choose("File", "New")

    if you.document.modified:
        you.answer(new, QMessageBox, discard)
    else:
        new()
    you.settle()
    you.expect(you.document.design.inputs == (), "New empties the hand")


def pick_of_list(you: Composer, box: QComboBox, text: str) -> None:
    """Open a drop-down list and click on a line of it."""
    if box.currentText() == text:
        return
    you.click(box)
    rows: QAbstractItemView = box.view()
    you.wait(rows.isVisible, "the list opens")
    # A list that has just opened takes a quick click for the second half of the first one.
    QTest.qWait(QApplication.doubleClickInterval() + 100)
    row = rows.model().index(box.findText(text), box.modelColumn())
    rows.scrollTo(row)
    you.click(rows, rows.visualRect(row).center())


def _sweep(you: Composer, order: str) -> None:
    inspector = you.window.panel("inspector")
    button = next(
        widget
        for widget in inspector.findChildren(QWidget)
        if getattr(widget, "text", str)() == "Sweep…"
    )
    you.click(button)
    dialog = you.page()
    pick_of_list(you, dialog.order, order)
    box = dialog.findChild(QDialogButtonBox)
    you.click(box.button(QDialogButtonBox.StandardButton.Ok))
    you.settle()


def _pick(you: Composer, dialog: QFileDialog, name: str) -> None:
    """Double click on a file of the list."""
    # As a list, or with sizes and dates.
    rows = next(
        widget for widget in dialog.findChildren(QAbstractItemView, _FILES) if widget.isVisible()
    )

    def row():
        model, root = rows.model(), rows.rootIndex()
        names = [model.index(k, 0, root) for k in range(model.rowCount(root))]
        return next((index for index in names if index.data() == name), None)

    you.wait(row, f"{name} is listed")
    rows.scrollTo(row())
    you.click(rows, rows.visualRect(row()).center(), double=True)


SCENES = (train, recording, sweep)
