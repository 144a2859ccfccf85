"""Ending the studio: by a signal, as when one logs out or a terminal closes, and for good."""

import os
import signal
import socket
import sys

from PySide6.QtCore import QObject, QSocketNotifier, Signal

from skinsource_gui.state.playing.sound_thread import one_is_stuck

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


def end_if_stuck(result: int) -> None:
    """End the process where a device is stuck: Python, and PortAudio, would wait for it for ever.

    What is to be kept must have been written.
    """
    if one_is_stuck():
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(result)


def _leave_it_to_the_socket(_number: int, _frame: object) -> None:
    pass
