"""A small picture of the work, by which one knows it again."""

from collections.abc import Callable, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from PySide6.QtCore import QBuffer, QByteArray, QObject, QRectF, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QColor, QImage, QPainter

from skinsource.base.errors import SkinSourceError
from skinsource.base.files import named
from skinsource.base.quoting import sentence
from skinsource.design import recovery
from skinsource.design.design import Design
from skinsource.design.design_file import DesignFile, open_design
from skinsource.design.recovery import Found, Session, UnsavedWork
from skinsource.design.view import View
from skinsource_gui.plots.small_map import SmallMap, SmallMaps, paint_small_map
from skinsource_gui.qt.theme import LIGHT
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import Engine

#: Width and height, px.
SIZE = QSize(120, 180)
_EDGE_PX = 4


class WorkPicture:
    """Remembers what was predicted last, and draws it with the inputs of the present design."""

    def __init__(self) -> None:
        self._maps = SmallMaps()
        self._shown: SmallMap | None = None

    def show_results(self, results: Mapping[str, Any]) -> None:
        """Take over what the panels show now."""
        if "limb_map" in results:
            self._shown = self._maps.map_of(results)

    def image(self, design: Design) -> QImage:
        """What is known of ``design``; an empty image before anything was predicted."""
        if self._shown is None:
            return QImage()
        image = QImage(SIZE, QImage.Format.Format_RGB32)
        image.fill(QColor(LIGHT.base))
        painter = QPainter(image)
        area = QRectF(image.rect()).adjusted(_EDGE_PX, _EDGE_PX, -_EDGE_PX, -_EDGE_PX)
        paint_small_map(painter, area, self._shown, design, LIGHT)
        painter.end()
        return image


def png_of(image: QImage) -> bytes:
    """PNG of an image; empty for an empty one."""
    if image.isNull():
        return b""
    content = QByteArray()
    buffer = QBuffer(content)
    buffer.open(QBuffer.OpenModeFlag.WriteOnly)
    # The stubs of PySide ask for bytes, which it does not take.
    saved: Any = image
    saved.save(buffer, "PNG")
    return bytes(content.data())


# Keeps copies of unsaved work while one works.

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


# Opens what earlier studios left unsaved.

# By then what the work predicts is painted.
_SURVIVED_AFTER_MS = 200


class Recovery(QObject):
    """Brings left-over work into the document, as work that is not saved.

    While a copy is opened a mark lies beside it, until its results are on the screen: where the
    studio does not survive that, the next one sets the copy aside and offers the one before.

    Parameters
    ----------
    document, engine
        Where it goes, and who evaluates it.
    folder
        The user's data folder.
    may_lose_changes
        Asks before other unsaved work goes.
    keep_now
        Keeps a copy of the present work; whether that went well.
    parent
        As in Qt.
    """

    #: The window's arrangement that a copy holds, bytes.
    opened = Signal(bytes)
    #: The file that the work belonged to, `Path` or None.
    belonged = Signal(object)
    #: What was opened, in a sentence.
    done = Signal(str)
    #: Why a copy was not opened, and where it lies now.
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
        """What there is to be opened now; nothing of it is."""
        return recovery.find(self._folder)

    def open(self, left: UnsavedWork) -> None:
        """Open the newest copy that can be; those that cannot be are set aside, and named."""
        if not self._may_lose_changes():
            return
        self._adopt()
        bad = []
        for copy in left.copies:
            recovery.mark_opening(copy)
            try:
                content = open_design(copy)
            except Exception as error:  # noqa: BLE001  whatever it is, an older copy may be good
                bad.append(_words_of(copy, error))
                continue
            self._opening = left, copy
            self._take_over(content, left.file)
            self.belonged.emit(left.file)
            words = f"Opened unsaved work on {left.name}, which was kept {left.age()}"
            if bad:
                before = "An earlier copy was opened instead."
                self.failed.emit(" ".join([*bad, before]))
            else:
                self.done.emit(words)
            if not self._engine.busy:
                self._survived.start()
            return
        self.failed.emit(" ".join(bad))

    def discard(self, left: UnsavedWork) -> None:
        """Delete it; where that is not possible, it is offered again."""
        recovery.discard(left)

    def end(self) -> None:
        """The studio ends, and has survived what it opened."""
        if self._opening is not None:
            recovery.mark_opened(self._opening[1])

    def _take_over(self, content: DesignFile, file: Path | None) -> None:
        document = self._document
        empty = type(content.design)(limb=content.design.limb)
        document.start_over(empty, content.view, None, recovered_from=file)
        document.edit("Open unsaved work", content.design)
        document.look(content.view)
        self.opened.emit(content.layout)

    def _settle(self) -> None:
        if self._opening is not None:
            self._survived.start()

    def _adopt(self) -> None:
        """Let this studio's own copies take the place of what it has opened and survived."""
        opening, self._opening = self._opening, None
        if opening is not None:
            left, copy = opening
            recovery.mark_opened(copy)
            # Taken back, given up or saved by now: then it is not needed any more either.
            if self._keep_now():
                recovery.discard(left)


def _words_of(copy: Path, error: Exception) -> str:
    why = str(error) if isinstance(error, SkinSourceError) else f"{copy.name}: {error!r}"
    where = recovery.set_aside(copy)
    kept = f"It was set aside: {named(where)}." if where else "It stays where it is."
    return f"{sentence(why)} {kept}"
