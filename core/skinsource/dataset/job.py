"""How a long job tells how far it is, and hears that it should stop."""

from collections.abc import Callable

from skinsource.errors import Cancelled

#: Called with (done, total, what is being done).
Progress = Callable[[int, int, str], None]
#: Asked between steps; True stops the job.
Stop = Callable[[], bool]


def silent(done: int, total: int, text: str) -> None:
    """Show no progress."""


def never() -> bool:
    """Do not stop."""
    return False


def stop_if(cancelled: Stop, text: str) -> None:
    """Raise `Cancelled` with ``text`` when ``cancelled`` says so."""
    if cancelled():
        raise Cancelled(text)
