"""How a long job tells how far it is, and hears that it should stop."""

from collections.abc import Callable

from skinsource.errors import Cancelled
from skinsource.graph import Stop

#: Called with (done, total, what is being done).
Progress = Callable[[int, int, str], None]


def silent(done: int, total: int, text: str) -> None:
    """Show no progress."""


def stop_if(cancelled: Stop, text: str) -> None:
    """Raise `Cancelled` with ``text`` when ``cancelled`` says so."""
    if cancelled():
        raise Cancelled(text)
