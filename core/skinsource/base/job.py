"""Long work: it tells how far it is, can be stopped, and ends with a result.

Nothing here knows what shows the progress, or in which thread the work is done.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from skinsource.base.errors import Stopped

#: Asked now and then by what takes long; once true, `skinsource.base.errors.Stopped` is raised.
Stop = Callable[[], bool]
#: Called with (done, total, what is being done); a total of 0 while that is not known.
Progress = Callable[[int, int, str], None]

Result = TypeVar("Result")
Result_co = TypeVar("Result_co", covariant=True)

# What was seen in less says nothing about the rest.
_LEAST_SEEN_S = 1.0
_MINUTE_S, _HOUR_S = 60, 3600


def never() -> bool:
    """Do not stop."""
    return False


def silent(done: int, total: int, text: str) -> None:
    """Show no progress."""


def stop_if(stop: Stop, text: str = "Stopped.") -> None:
    """Raise `skinsource.base.errors.Stopped` with ``text`` when ``stop`` says so."""
    if stop():
        raise Stopped(text)


class Work(Protocol[Result_co]):
    """A function that can be a job's work, with all else it takes already filled in."""

    def __call__(self, *, progress: Progress, stop: Stop) -> Result_co:
        """Do it; raise `skinsource.base.errors.Stopped` once ``stop`` says so."""


@dataclass(frozen=True, slots=True)
class Job(Generic[Result]):
    """Work that is started explicitly.

    Attributes
    ----------
    title
        What it does, for the user: "Exporting levels.csv".
    work
        Does it; ``functools.partial(install, folder)`` for instance.
    """

    title: str
    work: Work[Result]

    def run(self, progress: Progress = silent, stop: Stop = never) -> Result:
        """Do the work in this thread.

        Raises
        ------
        Stopped
            ``stop`` said so; nothing is left behind.
        Exception
            Whatever the work raises.
        """
        return self.work(progress=progress, stop=stop)


def seconds_left(done: int, total: int, elapsed_s: float) -> float | None:
    """Estimate how long a job will still take, in seconds; None while that cannot be said.

    Parameters
    ----------
    done, total
        How far it is, as `Progress` tells; a total of 0 is not known.
    elapsed_s
        How long it has run.
    """
    if done <= 0 or total <= 0 or elapsed_s < _LEAST_SEEN_S:
        return None
    return elapsed_s * max(total - done, 0) / done


def time_left_text(seconds: float | None) -> str:
    """Words such as "about 5 s left", "about 3 min left"; empty where nothing is known.

    Rounded up to whole seconds below ten, to fives below a minute, to minutes and half hours: a
    number that changes all the time is not read.
    """
    if seconds is None:
        return ""
    if seconds <= 10:
        return f"about {max(_up(seconds, 1), 1)} s left"
    if seconds <= _MINUTE_S - 5:
        return f"about {_up(seconds, 5)} s left"
    if seconds <= _HOUR_S - _MINUTE_S:
        return f"about {_up(seconds, _MINUTE_S) // _MINUTE_S} min left"
    return f"about {_up(seconds, _HOUR_S // 2) / _HOUR_S:g} h left"


def _up(seconds: float, step: int) -> int:
    return int(-(-seconds // step)) * step
