"""Opens what earlier studios left unsaved."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, QTimer, Signal

from skinsource.base.errors import SkinSourceError
from skinsource.base.files import named
from skinsource.base.quoting import sentence
from skinsource.design import recovery
from skinsource.design.design_file import DesignFile, open_design
from skinsource.design.recovery import Found, LeftOver
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import Engine

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
        self._opening: tuple[LeftOver, Path] | None = None
        self._survived = QTimer(self, singleShot=True, interval=_SURVIVED_AFTER_MS)
        self._survived.timeout.connect(self._adopt)
        engine.rested.connect(self._settle)

    def look(self) -> Found:
        """What there is to be opened now; nothing of it is."""
        return recovery.find(self._folder)

    def open(self, left: LeftOver) -> None:
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

    def discard(self, left: LeftOver) -> None:
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
