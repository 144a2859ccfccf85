"""Plays what is matched, again and again, while it is changed."""

from collections.abc import Callable

from skinsource.design import Design
from skinsource.playing import START_DB, Output
from skinsource.playing.session import Playing, Session
from skinsource.playing.stream import Stream
from skinsource.rigs import Rig


class Presenter:
    """Reference and test in turn on a device; where there is none, in silence: a rehearsal.

    `present` and `close` belong to one thread, which may wait for the device; `stop_at_once` to
    any.  The guard of the outputs stays: what would pass full scale ends what is played.

    Parameters
    ----------
    output
        What is played on.
    finished
        Called from the thread of the device, with its stream, when nothing is played any more.
    rig
        What is wired to the device, whose limits then hold; None: not known.
    """

    def __init__(
        self, output: Output, finished: Callable[[Stream], None], rig: Rig | None = None
    ) -> None:
        self._output, self._rig = output, rig
        self._session = Session(finished)
        self._playing: Playing | None = None
        self._stopped = False

    def present(self, design: Design, gain_db: float = START_DB) -> Playing:
        """Play ``design`` again and again, or go over to it without a click.

        Raises
        ------
        SkinSourceError
            The design cannot be played, or the device refuses; nothing is played then.
        """
        if self._stopped:
            self.close()
        if self._playing is not None:
            self._playing = self._session.change(
                self._playing, design, self._output, loops=True, rig=self._rig
            )
        if self._playing is None:
            self._playing = self._session.play(
                design, self._output, loops=True, at_s=0.0, gain_db=gain_db, rig=self._rig
            )
        if self._playing.stream is not None:
            self._playing.stream.deck.set_gain(gain_db)
        return self._playing

    @property
    def reason(self) -> str:
        """Why nothing is heard, and what to do; "" where it is, or nothing is played."""
        return "" if self._playing is None else self._playing.reason

    def stop_at_once(self) -> None:
        """Be silent within a millisecond."""
        self._stopped = True
        playing = self._playing
        if playing is not None and playing.stream is not None:
            playing.stream.deck.stop_at_once()

    def close(self) -> None:
        """End what is played, and let go of the device."""
        self._stopped, self._playing = False, None
        self._session.close()
