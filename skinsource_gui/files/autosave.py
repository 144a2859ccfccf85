"""Keeps copies of unsaved work while one works."""

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, Qt, QTimer, Signal
from PySide6.QtGui import QImage

from skinsource.base.errors import SkinSourceError
from skinsource.design.design import Design
from skinsource.design.design_file import DesignFile
from skinsource.design.recovery import Session
from skinsource.design.view import View
from skinsource_gui.files.work_picture import png_of
from skinsource_gui.state.document import Document

#: So soon after the first unsaved edit there is a copy: nothing else holds any of it yet.
FIRST_S = 1.0


@dataclass(frozen=True, slots=True)
class _Seen:
    """What the document held at a time."""

    design: Design
    view: View
    path: Path | None
    modified: bool


class Autosave(QObject):
    """Writes copies of unsaved work, in a thread of its own.

    The first soon after the first unsaved edit, then one at most one interval after an edit.

    Work that is saved, or taken back, has no copies.

    Parameters
    ----------
    document
        The work.
    folder
        The user's data folder; the copies lie below it.
    interval_s
        The longest time that may be lost.
    first_s
        The same of the first unsaved edits, where it is shorter.
    layout, picture
        Give the window's arrangement, and a picture of a design.
    parent
        As in Qt.
    """

    #: Why no copy can be written, in a sentence; once, until one is written again.
    failed = Signal(str)
    _landed = Signal(object)  # the reason or None, from the worker thread

    def __init__(
        self,
        document: Document,
        folder: Path,
        interval_s: float,
        layout: Callable[[], bytes],
        picture: Callable[[Design], QImage],
        parent: QObject,
        first_s: float = FIRST_S,
    ) -> None:
        super().__init__(parent)
        self._intervals_s = (min(first_s, interval_s), interval_s)
        self._document, self._layout, self._picture = document, layout, picture
        self._session = Session(folder)
        self._seen = self._look()
        self._worker: ThreadPoolExecutor | None = None
        self._complained = self._ended = False
        # Whether there is a copy of this work already.
        self._has_copy = False
        self._timer = QTimer(self, singleShot=True)
        self._timer.timeout.connect(self._keep_soon)
        self._landed.connect(self._report, Qt.ConnectionType.QueuedConnection)
        document.changed.connect(self._follow)
        document.title_changed.connect(self._follow)

    def keep_now(self) -> bool:
        """Write a copy of unsaved work before this returns: what follows may end the studio.

        Returns whether nothing is unsaved that has no copy.
        """
        return not self._document.modified or self._keep(self._look()).result()

    def end(self, *, forget: bool = True) -> None:
        """Stop; ``forget`` the copies where the user has answered for what is not saved."""
        if self._ended:
            return
        self._ended = True
        self._timer.stop()
        for signal in (self._document.changed, self._document.title_changed):
            signal.disconnect(self._follow)
        if self._worker is not None:
            if forget:
                self._worker.submit(self._session.forget)
            self._worker.shutdown(wait=True)

    def _look(self) -> _Seen:
        document = self._document
        file = document.path or document.recovered_from
        return _Seen(document.design, document.view, file, document.modified)

    def _follow(self) -> None:
        before, self._seen = self._seen, self._look()
        if not self._seen.modified:
            self._timer.stop()
            self._has_copy = False
            if self._worker is not None:
                self._worker.submit(self._session.forget)
            return
        if before.modified and before.design.limb != self._seen.design.limb:
            # Another limb is read and evaluated next.
            self._keep(before).result()
        if not self._timer.isActive():
            self._wait()

    def _wait(self) -> None:
        self._timer.start(round(1000 * self._intervals_s[self._has_copy]))

    def _keep_soon(self) -> None:
        if self._document.modified:
            self._keep(self._look())

    def _keep(self, seen: _Seen) -> "Future[bool]":
        if self._worker is None:
            self._worker = ThreadPoolExecutor(1, thread_name_prefix="skinsource-autosave")
        self._has_copy = True
        write = partial(self._write, seen, self._layout(), self._picture(seen.design))
        return self._worker.submit(write)

    def _write(self, seen: _Seen, layout: bytes, picture: QImage) -> bool:
        try:
            content = DesignFile(design=seen.design, view=seen.view, layout=layout)
            self._session.keep(content, seen.path, png_of(picture))
        except SkinSourceError as error:
            self._landed.emit(str(error))
            return False
        except Exception as error:  # noqa: BLE001  nobody else would hear of it
            self._landed.emit(f"The studio made a mistake: {type(error).__name__}: {error}.")
            return False
        self._landed.emit(None)
        return True

    def _report(self, reason: str | None) -> None:
        if reason is not None and not self._complained:
            self.failed.emit(f"No copy of unsaved work could be kept. {reason}")
        self._complained = reason is not None
        if self._complained and not self._ended and self._document.modified:
            # There may be room later, also where nothing more is edited.
            self._wait()
