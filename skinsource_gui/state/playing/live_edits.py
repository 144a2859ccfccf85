"""What is played follows what is edited."""

from functools import partial
from time import perf_counter
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from skinsource.base.errors import SkinSourceError
from skinsource.design.design import Design
from skinsource.lab.playing.devices import Output
from skinsource_gui.state.document import Document
from skinsource_gui.state.playing.late_session import LateSession
from skinsource_gui.state.playing.played_of import played_of
from skinsource_gui.state.playing.sound_thread import SoundThread

if TYPE_CHECKING:
    from skinsource.actuators.rigs import Rig
    from skinsource.lab.playing.session import Playing


class LiveEdits(QObject):
    """Renders the design anew at each edit, away from the GUI thread; the last one counts.

    Parameters
    ----------
    document
        What is followed.
    session, thread
        Who renders, and where.

    Attributes
    ----------
    render_s
        How long the last edit took until the device could have it; 0: there was none.
    """

    #: What plays the edited design.
    replaced = Signal(object)
    #: Why an edit is not heard: what was played before goes on.
    failed = Signal(str)

    def __init__(
        self, document: Document, session: LateSession, thread: SoundThread, parent: QObject
    ) -> None:
        super().__init__(parent)
        self._document, self._session, self._thread = document, session, thread
        self._playing: Playing | None = None
        self._rendered: tuple[Design, bool] | None = None
        self._output, self._loops = Output(), False
        self._rig: Rig | None = None
        self._busy = False
        self._edited_s = self.render_s = 0.0
        # When the first edit was made that waits for the one before it.
        self._waiting_s: float | None = None

    def begin(
        self, playing: "Playing", design: Design, output: Output, rig: "Rig | None", *, loops: bool
    ) -> None:
        """Follow the document, of which ``design`` is what is played."""
        self._playing, self._output, self._loops, self._rig = playing, output, loops, rig
        self._rendered, self.render_s, self._waiting_s = (design, loops), 0.0, None
        self._document.changed.connect(self._follow)
        self._follow()

    def end(self) -> None:
        """Follow no longer."""
        if self._playing is not None:
            self._playing = None
            self._document.changed.disconnect(self._follow)

    def loop(self, *, loops: bool) -> None:
        """Play a design without a loop again and again, or once."""
        self._loops = loops
        if self._playing is not None:
            self._follow()

    def _follow(self) -> None:
        wanted = played_of(self._document), self._loops
        if self._playing is None or self._rendered == wanted:
            self._waiting_s = None if self._rendered == wanted else self._waiting_s
            return
        since_s = perf_counter() if self._waiting_s is None else self._waiting_s
        if self._busy:
            # Its delay begins now, not when its turn comes.
            self._waiting_s = since_s
            return
        self._busy, self._rendered = True, wanted
        self._edited_s, self._waiting_s = since_s, None
        change = partial(
            self._session.made.change,
            self._playing,
            wanted[0],
            self._output,
            loops=wanted[1],
            rig=self._rig,
        )
        self._thread.do(partial(_timed, change), self._take)

    def _take(
        self, timed: "tuple[Playing | None, float] | None", error: SkinSourceError | None
    ) -> None:
        self._busy = False
        if self._playing is None:
            return
        if timed is None:
            self.failed.emit(f"Not heard yet: {error}")
        elif timed[0] is not None:
            self.render_s = timed[1] - self._edited_s
            self._playing = timed[0]
            self.replaced.emit(timed[0])
        # What was edited meanwhile.
        self._follow()


def _timed(change: "partial[Playing | None]") -> "tuple[Playing | None, float]":
    """What ``change`` returns, and when."""
    return change(), perf_counter()
