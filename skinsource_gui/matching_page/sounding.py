"""What is matched, played away from the GUI thread."""

from functools import partial

from PySide6.QtCore import QObject, Qt, Signal

from skinsource.actuators.rigs import Rig
from skinsource.base.errors import SkinSourceError
from skinsource.design.design import Design
from skinsource.lab.matching import Presenter
from skinsource.lab.playing.devices import Output
from skinsource.lab.playing.session import Playing
from skinsource.lab.playing.stream import Stream
from skinsource_gui.state.playing.sound_thread import SoundThread

_GONE = (
    "The device does not ask for sound any more: it may have been unplugged. Connect it, close "
    "this page, look for devices again (View > Panels > Playback), and come back: what was stored "
    "stays."
)


class Sounding(QObject):
    """Plays the latest of the designs that it is given, until it is stopped.

    Parameters
    ----------
    output, rig
        What is played on, and what is wired to it; None: not known.

    Attributes
    ----------
    now
        What is being played; None: nothing is.
    """

    #: Something is played, or something else; the `Playing`.
    began = Signal(object)
    #: Nothing is played any more, and why; "": somebody said so.
    ended = Signal(str)
    _finished = Signal(object)  # from the thread of the device

    def __init__(self, output: Output, rig: Rig | None, parent: QObject) -> None:
        super().__init__(parent)
        self._thread = SoundThread(self)
        self._presenter = Presenter(output, self._finished.emit, rig)
        self._finished.connect(self._end_of, Qt.ConnectionType.QueuedConnection)
        self._waiting: tuple[Design, float] | None = None
        self._busy = self._wanted = self._closed = False
        self.now: Playing | None = None

    @property
    def playing(self) -> bool:
        """Whether it plays, or is about to."""
        return self._wanted

    def play(self, design: Design, gain_db: float) -> None:
        """Play ``design``, or go over to it."""
        self._wanted = True
        self._waiting = design, gain_db
        self._next()

    def stop_at_once(self) -> None:
        """Be silent within a millisecond."""
        was = self._wanted
        self._wanted, self._waiting, self.now = False, None, None
        self._presenter.stop_at_once()
        if was:
            self.ended.emit("")

    def close(self) -> None:
        """Let go of the device, for good."""
        self._wanted, self._waiting, self.now, self._closed = False, None, None, True
        self._presenter.stop_at_once()
        self._thread.end(self._presenter.close)

    def _next(self) -> None:
        if self._busy or self._waiting is None or self._closed:
            return
        self._busy = True
        wanted, self._waiting = self._waiting, None
        self._thread.do(partial(self._presenter.present, *wanted), self._take)

    def _take(self, playing: Playing | None, error: SkinSourceError | None) -> None:
        self._busy = False
        if not self._wanted:
            # It was stopped before it began.
            self._presenter.stop_at_once()
        elif playing is None:
            self._wanted, self._waiting, self.now = False, None, None
            self.ended.emit(str(error))
        else:
            self.now = playing
            self.began.emit(playing)
            stream = playing.stream
            # What was too loud at once has ended before anybody could be told.
            if stream is not None and stream.deck.ending is not None:
                self._end_of(stream)
        self._next()

    def watch(self) -> None:
        """Find out whether the device is gone; nobody says so."""
        if self.now is not None and self.now.over:
            self._wanted, self._waiting, self.now = False, None, None
            self._presenter.stop_at_once()
            self.ended.emit(_GONE)

    def _end_of(self, stream: Stream) -> None:
        if stream.closed or self.now is None or self.now.stream is not stream:
            return
        self._wanted, self._waiting, self.now = False, None, None
        ending = stream.deck.ending
        self.ended.emit(_GONE if ending is None else ending.sentence)
