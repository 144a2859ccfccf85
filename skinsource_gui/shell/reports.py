"""What the studio says: what went wrong, what went well, what an evaluation gave."""

import logging

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QStatusBar

from skinsource.base.errors import SkinSourceError
from skinsource.design.design import Design
from skinsource.design.signal_path import unplayable_words
from skinsource_gui.shell.notice import PASSING_MS, Notice
from skinsource_gui.state.conductor import UNPLAYABLE
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import Outcome
from skinsource_gui.status.accuracy import Accuracy
from skinsource_gui.status.status_line import StatusLine

_log = logging.getLogger(__name__)


class Reports(QObject):
    """Brings news to the notice, the status bar and the status line.

    Parameters
    ----------
    document
        An edit of it outdates what was said before.
    notice, status_bar, status_line, accuracy
        Where it is said.
    """

    def __init__(
        self,
        document: Document,
        notice: Notice,
        status_bar: QStatusBar,
        status_line: StatusLine,
        accuracy: Accuracy,
    ) -> None:
        super().__init__(document)
        self._document, self._notice, self._status_bar = document, notice, status_bar
        self._status_line, self._accuracy = status_line, accuracy
        self._impossible = ""
        self._said_of: Design = document.design
        document.changed.connect(self._forget_outdated)
        document.told.connect(self.report)
        document.title_changed.connect(status_bar.clearMessage)

    def complain(self, reason: str) -> None:
        """Show what went wrong, where the user looks."""
        self._status_bar.clearMessage()
        self._said_of = self._document.design
        self._notice.say(reason, "error")

    def refuse(self, reason: str) -> None:
        """Show why an edit was not made; it goes again after a while, or at the next click."""
        self._status_bar.clearMessage()
        self._said_of = self._document.design
        self._notice.say(reason, "error", passes=True)

    def report(self, words: str) -> None:
        """Show what went well, for some seconds."""
        self._notice.be_quiet()
        if self._status_bar.isHidden():  # while presenting
            self._said_of = self._document.design
            self._notice.say(words, "info", passes=True)
        else:
            self._status_bar.showMessage(words, PASSING_MS)

    def explain(self, words: str) -> None:
        """Show what is no fault and may be long, whole: the status bar would cut it."""
        self._status_bar.clearMessage()
        self._said_of = self._document.design
        self._notice.say(words, "info", passes=True)

    def show_impossible(self, reason: str) -> None:
        """Say why there are no results."""
        self._impossible = reason
        self._status_line.show_no_outcome()
        self.complain(reason)

    def show_outcome(self, outcome: Outcome) -> None:
        """Take over what the panels show now, and say which inputs it is without."""
        words = unplayable_words((outcome.values or {}).get(UNPLAYABLE, ()))
        if words != self._impossible:
            if self._impossible and self._notice.text == self._impossible:
                self._notice.be_quiet()
            self._impossible = words
            if words:
                self.complain(words)
        self._status_line.show_outcome(outcome)
        self._accuracy.show_outcome(outcome)

    def log_fault(self, outcome: Outcome) -> None:
        """Write down a mistake of the studio."""
        if outcome.error is not None and not isinstance(outcome.error, SkinSourceError):
            _log.error("an evaluation failed", exc_info=outcome.error)

    def _forget_outdated(self) -> None:
        # Why there are no results, or none of an input, stays until there are some.
        edited = self._document.design is not self._said_of
        if edited and self._notice.text and self._notice.text != self._impossible:
            self._notice.be_quiet()
