"""The session of a player, once it plays."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from skinsource.lab.playing import session

if TYPE_CHECKING:
    from skinsource.lab.playing.session import Session
    from skinsource.lab.playing.stream import Stream


class LateSession:
    """Makes the session when it is first asked for: the studio starts without what plays.

    Parameters
    ----------
    finished
        What the session tells of a stream that plays no more.
    """

    def __init__(self, finished: "Callable[[Stream], None]") -> None:
        self._finished = finished
        self._session: Session | None = None

    @property
    def made(self) -> "Session":
        """The session."""
        if self._session is None:
            self._session = session.Session(self._finished)
        return self._session

    def close(self) -> None:
        """End what is played, if anything ever was."""
        if self._session is not None:
            self._session.close()
