"""Sees what goes wrong beside the point: exceptions anywhere, warnings of Qt and of Python."""

import sys
import threading
import traceback
from collections.abc import Iterator
from contextlib import contextmanager

from PySide6.QtCore import QtMsgType, qInstallMessageHandler

# What the offscreen platform says of windows, popups and tooltips.
_HARMLESS = ("This plugin does not support", "propagateSizeHints")


class Watch:
    """Collects faults.

    Attributes
    ----------
    faults
        What went wrong, in words.
    """

    def __init__(self) -> None:
        self.faults: list[str] = []

    def on_outcome(self, outcome) -> None:
        """An evaluation ended: one that failed says why in the studio's own words."""
        import skinsource as ss

        if outcome.error is not None and not isinstance(outcome.error, ss.SkinSourceError):
            self.faults.append("".join(traceback.format_exception(outcome.error)))

    @contextmanager
    def looking(self) -> Iterator[None]:
        """Look while this holds."""
        hooks = sys.excepthook, threading.excepthook, sys.unraisablehook
        sys.excepthook = self._raised
        threading.excepthook = lambda about: self._raised(
            about.exc_type, about.exc_value, about.exc_traceback
        )
        sys.unraisablehook = lambda about: self._raised(
            about.exc_type, about.exc_value, about.exc_traceback
        )
        before = qInstallMessageHandler(self._said)
        try:
            yield
        finally:
            qInstallMessageHandler(before)
            sys.excepthook, threading.excepthook, sys.unraisablehook = hooks

    def _raised(self, kind, error, trace) -> None:
        self.faults.append("".join(traceback.format_exception(kind, error, trace)))

    def _said(self, kind: QtMsgType, _context, message: str) -> None:
        loud = kind not in (QtMsgType.QtDebugMsg, QtMsgType.QtInfoMsg)
        if loud and not any(phrase in message for phrase in _HARMLESS):
            self.faults.append(f"Qt: {message}")
