"""Ending the studio from outside: by a signal, as when one logs out or a terminal closes."""

import signal
import socket
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, QSocketNotifier, Signal

from skinsource.errors import SkinSourceError
from skinsource_gui.files.kept_work import KeptWork
from skinsource_gui.shell.notice import Notice
from skinsource_gui.state.document import Document

_SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP")


class EndSignals(QObject):
    """Tells when the system asks the studio to end.

    Python handles signals between two of its own steps only, and there are none while Qt waits
    for events: a byte that arrives at a socket wakes it.
    """

    #: The studio shall end.
    received = Signal()

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._ours, theirs = socket.socketpair()
        self._theirs = theirs
        for end in (self._ours, theirs):
            end.setblocking(False)
        signal.set_wakeup_fd(theirs.fileno(), warn_on_full_buffer=False)
        for name in _SIGNALS:
            number = getattr(signal, name, None)  # Windows has no SIGHUP
            if number is not None:
                signal.signal(number, _leave_it_to_the_socket)
        self._notifier = QSocketNotifier(self._ours.fileno(), QSocketNotifier.Type.Read, self)
        self._notifier.activated.connect(self._hear)

    def _hear(self) -> None:
        self._ours.recv(64)
        self.received.emit()


def _leave_it_to_the_socket(_number: int, _frame: object) -> None:
    pass


def keep_unsaved(document: Document, kept: KeptWork) -> None:
    """Keep a copy of what ``document`` has not saved; where that fails, say so on stderr."""
    if document.modified:
        try:
            kept.keep(document)
        except SkinSourceError as error:
            sys.stderr.write(f"skinsource-gui: unsaved work is lost: {error}\n")


def offer_kept(
    document: Document, kept: KeptWork, notice: Notice, complain: Callable[[str], None]
) -> None:
    """Offer the work that was kept when the studio was ended last, if there is any."""
    path = kept.newest()
    if path is None:
        return
    notice.say(
        "The studio was ended before your work was saved. A copy was kept.",
        "warning",
        (
            ("Open it", partial(_open, path, document, kept, complain)),
            ("Discard it", partial(kept.discard, path)),
        ),
    )


def _open(path: Path, document: Document, kept: KeptWork, complain: Callable[[str], None]) -> None:
    try:
        kept.open(path, document)
    except SkinSourceError as error:
        complain(str(error))
