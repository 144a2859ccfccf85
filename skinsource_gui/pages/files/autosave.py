"""Copies of unsaved work: they are written while the user works, and opened after a crash.

Each copy holds the design, its view, the arrangement of the window, and a small picture by which
the user recognises the work.
"""

from collections.abc import Callable, Mapping
from concurrent.futures import Future
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QDeadlineTimer, QObject, QRectF, QSize, Qt, QTimer, Signal

from skinsource.base.errors import SkinSourceError, sentence
from skinsource.base.files import path_text
from skinsource.design import recovery
from skinsource.design.design import Design, View
from skinsource.design.design_file import DesignFile, open_design
from skinsource.design.recovery import Found, Session, UnsavedWork
from skinsource_gui.plots.pictures import png_of
from skinsource_gui.plots.small_map import SmallMap, paint_small_map, small_map_of
from skinsource_gui.qt.theme import LIGHT
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import Engine
from skinsource_gui.state.worker import Worker, fault_text

#: Width and height, px.
SIZE = QSize(120, 180)
_EDGE_PX = 4


class WorkPicture:
    """Draws the latest prediction, with the inputs of the present design."""

    def __init__(self) -> None:
        self._map: SmallMap | None = None

    def show_results(self, results: Mapping[str, Any]) -> None:
        """Remember the map of the results that the panels show now."""
        if "limb_map" in results:
            self._map = small_map_of(results)

    def image(self, design: Design) -> QtGui.QImage:
        """Return a picture of ``design``; an empty image before anything was predicted."""
        if self._map is None:
            return QtGui.QImage()
        image = QtGui.QImage(SIZE, QtGui.QImage.Format.Format_RGB32)
        image.fill(QtGui.QColor(LIGHT.base))
        painter = QtGui.QPainter(image)
        area = QRectF(image.rect()).adjusted(_EDGE_PX, _EDGE_PX, -_EDGE_PX, -_EDGE_PX)
        paint_small_map(painter, area, self._map, design, LIGHT)
        painter.end()
        return image


#: Delay of a copy after the last edit, s.
PAUSE_S = 2.0
#: Longest delay of the first copy, s: no copy holds any of the work yet.
FIRST_S = 1.0


@dataclass(frozen=True, slots=True)
class _State:
    """State of the document at a time."""

    design: Design
    view: View
    path: Path | None
    modified: bool


class Autosave(QObject):
    """Writes copies of unsaved work, in a thread of its own.

    The first copy is written soon after the first unsaved edit, the next ones when edits pause, at
    most one interval after an edit, and never while a mouse button is down.  When the work is saved
    or undone, its copies are deleted.

    Parameters
    ----------
    document
        The document whose work is copied.
    folder
        The user's data folder, which contains the copies.
    interval_s
        The longest time of work that may be lost.
    first_s
        The same for the first unsaved edits, where it is shorter.
    layout, picture
        Return the window's arrangement, and a picture of a design.
    pause_s
        How long edits pause before a copy is written.
    """

    #: Why no copy can be written, as a sentence; once, until a copy is written again.
    failed = Signal(str)

    def __init__(
        self,
        document: Document,
        folder: Path,
        interval_s: float,
        layout: Callable[[], bytes],
        picture: Callable[[Design], QtGui.QImage],
        parent: QObject,
        first_s: float = FIRST_S,
        pause_s: float = PAUSE_S,
    ) -> None:
        super().__init__(parent)
        self._intervals_s = (min(first_s, interval_s), interval_s)
        self._pause_ms, self._latest = round(1000 * pause_s), QDeadlineTimer()
        self._document, self._layout, self._picture = document, layout, picture
        self._session = Session(folder)
        self._state = self._look()
        self._worker = Worker("skinsource-autosave", self)
        self._complained = self._ended = False
        # Whether there is a copy of this work already.
        self._has_copy = False
        self._timer = QTimer(self, singleShot=True)
        self._timer.timeout.connect(self._keep_soon)
        document.changed.connect(self._follow)
        document.title_changed.connect(self._follow)

    def keep_now(self) -> bool:
        """Write a copy of unsaved work at once, and return whether all unsaved work has a copy.

        It is called before a step that might end the studio.
        """
        return not self._document.modified or self._keep(self._look()).result()

    def end(self, *, forget: bool = True) -> None:
        """Stop; ``forget`` the copies where the user has decided on unsaved work."""
        if self._ended:
            return
        self._ended = True
        self._timer.stop()
        for signal in (self._document.changed, self._document.title_changed):
            signal.disconnect(self._follow)
        self._worker.close(self._session.forget if forget else None, finish=True)

    def _look(self) -> _State:
        document = self._document
        file = document.path or document.recovered_from
        return _State(document.design, document.view, file, document.modified)

    def _follow(self) -> None:
        before, self._state = self._state, self._look()
        if not self._state.modified:
            self._timer.stop()
            self._has_copy = False
            if self._worker.used:
                self._worker.run(self._session.forget)
            return
        if before.modified and before.design.limb != self._state.design.limb:
            # Another limb is read and evaluated next.
            self._keep(before).result()
        self._wait()

    def _wait(self) -> None:
        if not self._timer.isActive():
            self._latest.setRemainingTime(round(1000 * self._intervals_s[self._has_copy]))
        self._timer.start(min(self._pause_ms, self._latest.remainingTime()))

    def _keep_soon(self) -> None:
        if QtWidgets.QApplication.mouseButtons() != Qt.MouseButton.NoButton:
            self._timer.start(self._pause_ms)
        elif self._document.modified:
            self._keep(self._look())

    def _keep(self, state: _State) -> "Future[bool]":
        self._has_copy = True
        write = partial(self._write, state, self._layout(), self._picture(state.design))
        return self._worker.run(write)

    def _write(self, state: _State, layout: bytes, picture: QtGui.QImage) -> bool:
        try:
            content = DesignFile(design=state.design, view=state.view, layout=layout)
            self._session.keep(content, state.path, png_of(picture))
        except Exception as error:  # noqa: BLE001  it would be lost in the thread
            self._worker.tell(self._report, fault_text(error))
            return False
        self._worker.tell(self._report, None)
        return True

    def _report(self, reason: str | None) -> None:
        if reason is not None and not self._complained:
            self.failed.emit(f"No copy of unsaved work could be stored. {reason}")
        self._complained = reason is not None
        if self._complained and not self._ended and self._document.modified:
            # Writing may succeed later, even without another edit.
            self._wait()


# By then the results of the opened work are painted.
_SURVIVED_AFTER_MS = 200


class Recovery(QObject):
    """Opens work that earlier studios left unsaved, again as unsaved work.

    While a copy is opened, a mark file next to it says so, until its results are on the screen.
    Where the studio crashes meanwhile, the next one sets the copy aside and offers an older one.

    Parameters
    ----------
    document, engine
        The document that gets the work, and the engine that evaluates it.
    folder
        The user's data folder.
    may_lose_changes
        Asks before other unsaved work is lost.
    keep_now
        Writes a copy of the present work; returns whether that went well.
    """

    #: The window's arrangement in a copy, bytes.
    opened = Signal(bytes)
    #: The file that the work belonged to, `Path` or None.
    belonged = Signal(object)
    #: What was opened, as a sentence.
    done = Signal(str)
    #: Why a copy was not opened, and where it is now.
    failed = Signal(str)

    def __init__(
        self,
        document: Document,
        engine: Engine,
        folder: Path,
        may_lose_changes: Callable[[], bool],
        keep_now: Callable[[], bool],
        parent: QObject,
    ) -> None:
        super().__init__(parent)
        self._document, self._engine, self._folder = document, engine, folder
        self._may_lose_changes, self._keep_now = may_lose_changes, keep_now
        self._opening: tuple[UnsavedWork, Path] | None = None
        self._survived = QTimer(self, singleShot=True, interval=_SURVIVED_AFTER_MS)
        self._survived.timeout.connect(self._adopt)
        engine.rested.connect(self._settle)

    def look(self) -> Found:
        """Return the work that can be opened; nothing is opened yet."""
        return recovery.find(self._folder)

    def open(self, left: UnsavedWork) -> None:
        """Open the newest readable copy; newer ones are set aside and reported."""
        if not self._may_lose_changes():
            return
        self._adopt()
        bad = []
        for copy in left.copies:
            recovery.mark_opening(copy)
            try:
                content = open_design(copy)
            except Exception as error:  # noqa: BLE001  whatever it is, an older copy may be good
                bad.append(_set_aside(copy, error))
                continue
            self._opening = left, copy
            self._document.recover(content.design, content.view, left.file)
            self.opened.emit(content.layout)
            self.belonged.emit(left.file)
            if bad:
                self.failed.emit(" ".join([*bad, "An earlier copy was opened instead."]))
            else:
                self.done.emit(f"Opened unsaved work on {left.name}, stored at {left.clock()}")
            if not self._engine.busy:
                self._survived.start()
            return
        self.failed.emit(" ".join(bad))

    def end(self) -> None:
        """Remove the mark of the opened copy when the studio ends without a crash."""
        if self._opening is not None:
            recovery.mark_opened(self._opening[1])

    def _settle(self) -> None:
        if self._opening is not None:
            self._survived.start()

    def _adopt(self) -> None:
        """Delete the opened work once this studio has copies of its own."""
        opening, self._opening = self._opening, None
        if opening is not None:
            left, copy = opening
            recovery.mark_opened(copy)
            # This also holds where the work was undone, given up or saved meanwhile.
            if self._keep_now():
                recovery.discard(left)


def _set_aside(copy: Path, error: Exception) -> str:
    """Set a copy aside that could not be opened; return why, and where it is now."""
    reason = str(error) if isinstance(error, SkinSourceError) else f"{copy.name}: {error!r}"
    new_path = recovery.set_aside(copy)
    place = f"It was set aside: {path_text(new_path)}." if new_path else "It stays where it is."
    return f"{sentence(reason)} {place}"
