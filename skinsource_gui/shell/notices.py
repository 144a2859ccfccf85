"""What the studio reports: errors, hints, results of jobs, and what is offered."""

import logging
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QObject, QPoint, QRect, Qt, QTimer, Signal
from shiboken6 import isValid

from skinsource.base.errors import SkinSourceError
from skinsource.base.job import Job
from skinsource.design.design import Design, View
from skinsource.design.edits.setup import mends
from skinsource.design.labels import LIMBS
from skinsource.design.signal_path import unplayable_text
from skinsource.limbs.dataset.store import StoreInfo
from skinsource_gui.plots.figure import shrunk
from skinsource_gui.qt.buttons import page_button, page_label, tool_button
from skinsource_gui.qt.layouts import in_column, in_row, named
from skinsource_gui.qt.questions import ask_yes
from skinsource_gui.qt.theme import UNIT_PX, set_tone
from skinsource_gui.qt.windows import WindowEvents, application
from skinsource_gui.shell.status import Accuracy, StatusLine
from skinsource_gui.state.conductor import UNPLAYABLE
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import Outcome
from skinsource_gui.state.job_runner import JobRunner
from skinsource_gui.state.preferences import INSTALLATIONS, InstalledLimbs, Preferences
from skinsource_gui.state.worker import fault_text

#: How long a passing text stays at least, and in addition for each letter.
_LEAST_MS, _LETTER_MS = 4000, 60
#: A click so soon is not meant for the notice, and does not hide it.
_FRESH_MS = 700
#: A button of a notice: its text, and what it does.
Choice = tuple[str, Callable[[], object]]
_LAID_OUT = (QEvent.Type.Resize, QEvent.Type.LayoutRequest)
# Width of a card, unless its buttons need more.
_CARD_LETTERS = 56


class Notice(QObject):
    """A text in front of a window, which stays until it is closed, replaced or out of date.

    It moves no panel: one that stays is a card over the lower left corner, where the map is; a
    passing one lies over the status bar, or, while that is hidden, over the upper right corner.  A
    click on the notice, or where one of its buttons has just been, reaches nothing else.

    Parameters
    ----------
    window
        The window; also the parent.

    Attributes
    ----------
    card
        Holds the text and its buttons.
    """

    #: The user has closed it with its cross.
    closed = Signal()

    def __init__(self, window: QtWidgets.QMainWindow) -> None:
        super().__init__(window)
        self._window, self._passes = window, False
        self.card = named(QtWidgets.QFrame(window), "notice")
        self._label = page_label("notice_text")
        self._picture = named(QtWidgets.QLabel(), "notice_picture")
        self._choices: list[QtWidgets.QPushButton] = []
        hint = "Close this notice"
        self._close = tool_button(None, "close_notice", "✕", hint, takes_keyboard=False)
        self._close.setAccessibleName(hint)
        self._close.clicked.connect(self._choose)
        self._close.clicked.connect(self.closed)
        top = Qt.AlignmentFlag.AlignTop
        head = in_row(self._picture, (self._label, 1), self._close, gap_px=UNIT_PX)
        head.setAlignment(self._close, top)
        self._row = in_row(None, margins=0, gap_px=UNIT_PX)
        self._column = in_column(head, self._row, of=self.card, gap_px=UNIT_PX // 2)
        self._focused: QtWidgets.QWidget | None = None
        self._passing, self._watches = QTimer(self), False
        self._passing.setSingleShot(True)
        self._passing.timeout.connect(self.be_quiet)
        self.be_quiet()
        WindowEvents.follow(window, self._fit, *_LAID_OUT)

    @property
    def text(self) -> str:
        """The text; "" while it is hidden."""
        return self._label.text() if not self.card.isHidden() else ""

    def say(
        self,
        text: str,
        kind: str = "info",
        choices: Sequence[Choice] = (),
        picture: QtGui.QPixmap | None = None,
        *,
        passes: bool = False,
    ) -> None:
        """Show ``text``; ``kind`` is ``"error"``, ``"warning"`` or ``"info"``.

        A ``picture`` stands before the text.  A notice that ``passes`` is hidden after a while,
        which is long enough to read it, or at the next click anywhere.
        """
        self._passes, focused = passes, self._window.focusWidget()
        if not self.card.isAncestorOf(focused):
            self._focused = focused
        self._offer(choices)
        self._picture.setPixmap(picture or QtGui.QPixmap())
        self._picture.setHidden(picture is None or picture.isNull())
        self._label.setText(text)
        set_tone(self.card, kind)
        self.card.show()
        self._place()
        self._let_pass(_LEAST_MS + _LETTER_MS * len(text) if passes else None)

    def pass_now(self) -> None:
        """Hide a passing notice."""
        if self._passes:
            self.be_quiet()

    def be_quiet(self) -> None:
        """Hide the notice; the keyboard goes back to where it was."""
        if self.card.isAncestorOf(self._window.focusWidget()):
            before = self._focused
            (before if before is not None and isValid(before) else self._window).setFocus()
        self._let_pass(None)
        self.card.hide()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.MouseButtonPress and self._passing.isActive():
            stood_ms = self._passing.interval() - self._passing.remainingTime()
            if stood_ms >= _FRESH_MS and not self.card.underMouse():
                self.be_quiet()
        return super().eventFilter(watched, event)

    def _fit(self, event: QEvent) -> None:
        if self.text:
            self._place()

    def _let_pass(self, after_ms: int | None) -> None:
        """Hide it after a while, or at a click; None: let it stay."""
        # A filter on all events of the studio is installed for some seconds only.
        if self._watches:
            application().removeEventFilter(self)
        self._passing.stop()
        self._watches = after_ms is not None
        if after_ms is not None:
            application().installEventFilter(self)
            self._passing.start(after_ms)

    def _offer(self, choices: Sequence[Choice]) -> None:
        for button in self._choices:
            button.hide()
            button.deleteLater()
        self._choices = []
        for text, act in choices:
            button = page_button("notice_choice", text)
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
            button.clicked.connect(partial(self._choose, act))
            self._row.addWidget(button)
            self._choices.append(button)

    def _choose(self, act: Callable[[], object] | None = None, _checked: bool = False) -> None:
        self.be_quiet()
        if act:
            act()

    def _place(self) -> None:
        bar, whole = self._window.statusBar(), self._window.rect()
        edge = 1 if self._passes else UNIT_PX
        self._column.setContentsMargins(UNIT_PX, edge, UNIT_PX, edge)
        at_top = self._passes and bar.isHidden()
        self._close.setHidden(at_top)
        stage = self._window.findChild(QtWidgets.QWidget, "stage_caution") if at_top else None
        room_px, text = whole.width() - 6 * UNIT_PX, self._label.text()
        # Above the stage there is room for one line.
        font = QtGui.QFont() if stage is None else shrunk(stage.font(), [text], room_px)
        self._label.setFont(font)
        # In letters of any size a line of the card has about as many letters.
        letter_px = self._label.fontMetrics().averageCharWidth()
        card_px = max(_CARD_LETTERS * letter_px, self.card.minimumSizeHint().width())
        widest = whole.width() if self._passes else card_px
        width = min(widest, whole.width() - (0 if self._passes else 2 * UNIT_PX))
        if at_top:
            text_px = self._label.fontMetrics().horizontalAdvance(text)
            width = min(width, text_px + 6 * UNIT_PX)
        height = self.card.heightForWidth(width)
        if at_top:
            place = QRect(whole.width() - width, 0, width, height)
        elif self._passes:
            height = max(height, bar.height())
            place = QRect(0, whole.height() - height, width, height)
        else:
            bottom = whole.height() if bar.isHidden() else bar.y()
            place = QRect(UNIT_PX, bottom - height - UNIT_PX, width, height)
            # The colours of the map, which lies there, stay in sight.
            colours = self._window.findChild(QtWidgets.QWidget, "skin_colour_bar")
            if colours is not None and colours.isVisible() and colours.window() is self._window:
                bar_place = QRect(colours.mapTo(self._window, QPoint()), colours.size())
                if bar_place.intersects(place):
                    place.moveBottom(bar_place.top() - UNIT_PX)
        self.card.setGeometry(place)
        # Panels that are docked later would lie over it.
        self.card.raise_()


HINTS = (
    "Click a place on the hand: an input is added there, and the skin map shows what reaches the "
    "skin.",
    "Change its numbers in the clip panel: drag on a field, or click it, and scroll or type. "
    "The map follows while you drag.",
    "Click outputs on the skin map: traces and spectra show them. File > Scenes opens figures of "
    "the paper to begin with.",
)
NEXT, DONE, ENOUGH = "Next", "Done", "No more hints"
LATER = "The first steps are shown in the workspace Compose"


class FirstHints(QObject):
    """Shows three hints, one after the other, on the first start of the studio.

    The next one comes with its button, or once the hint was followed.  They are hidden from an
    audience, and where there is no hand to click on.

    Parameters
    ----------
    preferences
        Store that the hints were shown, as soon as the first one is.
    notice
        Shows them; also the parent.
    document
        Its changes tell whether a hint was followed.
    """

    def __init__(self, preferences: Preferences, notice: Notice, document: Document) -> None:
        super().__init__(notice)
        self._preferences, self._notice, self._document = preferences, notice, document
        self._step: int | None = None
        self._away = False
        self._design, self._view = document.design, document.view

    def offer(self) -> None:
        """Begin, unless they were shown before or the notice shows something else."""
        if self._preferences.hinted or self._notice.text:
            return
        self.show()

    def show(self) -> None:
        """Begin with the first hint, also if they were shown before."""
        self._preferences.hinted = True
        self._preferences.flush()
        self._end()
        self._notice.closed.connect(self._end)
        self._document.settled.connect(self._follow)
        self._say(0)
        if self._away:
            self._notice.say(LATER, passes=True)

    def put_away(self, away: bool) -> None:
        """Hide the present hint, or show it again."""
        was, self._away = self._away, away
        if self._step is None or away == was:
            return
        if not away:
            self._say(self._step)
        elif self._says_a_hint:
            self._notice.be_quiet()

    @property
    def _says_a_hint(self) -> bool:
        return self._notice.text.endswith(HINTS)

    def _say(self, step: int) -> None:
        self._step = step
        self._design, self._view = self._document.design, self._document.view
        if self._away:
            return
        text = f"{step + 1} of {len(HINTS)}: {HINTS[step]}"
        choices: tuple[Choice, ...] = ((DONE, self._end),)
        if step < len(HINTS) - 1:
            choices = ((NEXT, lambda: self._say(step + 1)), (ENOUGH, self._end))
        self._notice.say(text, choices=choices)

    def _follow(self) -> None:
        """Show the next hint where this one was followed; show this one again if an edit hid it."""
        if self._step is None or self._away:
            return
        design, view = self._document.design, self._document.view
        if not _was_followed(self._step, self._design, self._view, design, view):
            if not self._notice.text:
                self._say(self._step)
        elif self._step + 1 < len(HINTS):
            self._say(self._step + 1)
        else:
            self._end()
            if self._says_a_hint:
                self._notice.be_quiet()

    def _end(self) -> None:
        """End the hints; the notice is hidden by whoever ends them."""
        if self._step is not None:
            self._step = None
            self._notice.closed.disconnect(self._end)
            self._document.settled.disconnect(self._follow)


def _was_followed(step: int, was: Design, looked: View, design: Design, view: View) -> bool:
    """Return whether hint ``step`` was followed since it was shown."""
    if step == 0:
        return len(design.inputs) > len(was.inputs)
    if step == 1:
        return design.inputs != was.inputs
    return bool(view.outputs) and view.outputs != looked.outputs


_log = logging.getLogger(__name__)


class Reports(QObject):
    """Shows errors, messages and outcomes in the notice and the status bar.

    Parameters
    ----------
    document
        Its edits hide notices on an older design.
    notice, status_bar, status_line, accuracy
        The parts of the window that show reports.
    """

    def __init__(
        self,
        document: Document,
        notice: Notice,
        status_bar: QtWidgets.QStatusBar,
        status_line: StatusLine,
        accuracy: Accuracy,
    ) -> None:
        super().__init__(document)
        self._document, self._notice, self._status_bar = document, notice, status_bar
        self._status_line, self._accuracy = status_line, accuracy
        self._impossible = ""
        self._reported_design: Design = document.design
        document.changed.connect(self._forget_outdated)
        document.message.connect(self.report)
        # What was said of a step is no longer true once it is undone.
        for outdates in (document.title_changed, document.jumped):
            outdates.connect(status_bar.clearMessage)

    def complain(self, reason: str) -> None:
        """Show an error until it is dealt with."""
        self._show(reason, "error")

    def refuse(self, reason: str) -> None:
        """Show why an edit was not made; it passes after a while, or at the next click."""
        self._show(reason, "error", passes=True)

    def report(self, text: str) -> None:
        """Show a message for as long as it takes to read."""
        self._notice.be_quiet()
        if not self._status_bar.isHidden():  # as it is while presenting
            self._status_bar.showMessage(text, _LEAST_MS + _LETTER_MS * len(text))
            if self._status_line.text() == text:
                return
            self._status_bar.clearMessage()
        self.explain(text)

    def explain(self, text: str) -> None:
        """Show a text that is no error and is too long for the status bar."""
        self._show(text, "info", passes=True)

    def show_impossible(self, reason: str) -> None:
        """Show why there are no results."""
        self._impossible = reason
        self._status_line.show_no_outcome()
        self.complain(reason)

    def show_outcome(self, outcome: Outcome) -> None:
        """Take over the outcome that panels show, and report inputs that cannot be played."""
        unplayable = (outcome.values or {}).get(UNPLAYABLE, ())
        text = unplayable_text(unplayable)
        if text != self._impossible:
            if self._impossible and self._notice.text == self._impossible:
                self._notice.be_quiet()
            self._impossible = text
            if text:
                self._show(text, "error", choices=self._mends(unplayable[0].id))
        self._status_line.show_outcome(outcome)
        self._accuracy.show_outcome(outcome)

    def _mends(self, id: int) -> list[Choice]:
        """Return the buttons that let an input be played, or leave it out."""
        document = self._document

        def mend(label: str) -> None:
            # The design may have been edited since.
            for edit in mends(document.design, document.view, id):
                if edit.label == label:
                    document.apply(edit)

        if id not in document.design.ids:
            return []
        edits = mends(document.design, document.view, id)
        return [(edit.label, partial(mend, edit.label)) for edit in edits]

    def log_fault(self, outcome: Outcome) -> None:
        """Log an error that is a fault of the studio."""
        if outcome.error is not None and not isinstance(outcome.error, SkinSourceError):
            _log.error("an evaluation failed", exc_info=outcome.error)

    def _show(
        self, text: str, kind: str, *, choices: Sequence[Choice] = (), passes: bool = False
    ) -> None:
        self._status_bar.clearMessage()
        self._reported_design = self._document.design
        self._notice.say(text, kind, choices, passes=passes)

    def _forget_outdated(self) -> None:
        # The reason for missing results stays until they are there.
        edited = self._document.design is not self._reported_design
        if edited and self._notice.text and self._notice.text != self._impossible:
            self._notice.be_quiet()


class Installations(QObject):
    """Updates the limbs after installations, and reports their results.

    The page that started an installation may be closed by then.

    Parameters
    ----------
    runner
        Runs installations; also the parent.
    limbs, reports
        The installed limbs, and the reports of the window.
    """

    def __init__(self, runner: JobRunner, limbs: InstalledLimbs, reports: Reports) -> None:
        super().__init__(runner)
        self._limbs, self._reports = limbs, reports
        self._limb_names = limbs.names
        limbs.changed.connect(self._note_changed)
        runner.done.connect(self._note_done)
        runner.failed.connect(self._note_failed)

    def _note_changed(self) -> None:
        """Report which limbs were installed or removed, also from outside the studio."""
        before, self._limb_names = self._limb_names, self._limbs.names
        installed = [_title(limb) for limb in self._limb_names if limb not in before]
        removed = [_title(limb) for limb in before if limb not in self._limb_names]
        sentences = []
        if installed:
            sentences.append(
                f"{', '.join(installed)}: installed, choose it beside Search, above the panels"
            )
        if removed:
            sentences.append(f"{', '.join(removed)}: no longer installed")
        self._reports.report(". ".join(sentences))

    def _note_done(self, job: Job[Any], result: object) -> None:
        if job.title in INSTALLATIONS:
            self._limbs.look()
            note = f" Note: {result.note}." if isinstance(result, StoreInfo) and result.note else ""
            self._reports.report(f"The measured limbs are installed.{note}")

    def _note_failed(self, job: Job[Any], error: Exception) -> None:
        if job.title in INSTALLATIONS:
            self._reports.complain(fault_text(error))


def _title(limb: str) -> str:
    """Return the title of a limb in the window."""
    return next((word.title for word in LIMBS if word.name == limb), limb)


class RunningJobs(QObject):
    """Says that jobs run, and asks before the window closes meanwhile.

    Parameters
    ----------
    runner
        Runs the jobs.
    window
        In front of which questions are asked; also the parent.
    """

    def __init__(self, runner: JobRunner, window: QtWidgets.QWidget) -> None:
        super().__init__(window)
        self._runner, self._window = runner, window

    def show_on(self, cancel: QtGui.QAction) -> None:
        """Enable that action only while there is something to cancel."""

        def show() -> None:
            cancel.setEnabled(self._runner.current is not None)

        self._runner.changed.connect(show)
        show()

    def may_close(self) -> bool:
        """Return whether the window may close: no job runs, or the user gives it up."""
        titles = "; ".join(job.title for job in self._runner.unfinished)
        if not titles:
            return True
        question = f"Still running: {titles}. Stop it and close? Unfinished files are removed."
        return ask_yes(self._window, "Something is running", question)

    def end(self) -> None:
        """Stop all jobs for good, and clear them away."""
        if self._runner.busy:
            # It can take a second to clear away a gigabyte.
            self._window.hide()
        self._runner.close()
