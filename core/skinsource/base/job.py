"""Long work that reports its progress, can be stopped, and ends with a result.

Nothing here knows what shows the progress, or in which thread the work runs.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from skinsource.base.errors import Stopped

#: Long work calls it now and then; once it returns True, `skinsource.base.errors.Stopped` is
#: raised.
Stop = Callable[[], bool]
#: Long work calls it with (done, total, description of the step); total is 0 while not known.
Progress = Callable[[int, int, str], None]

Result = TypeVar("Result")
Result_co = TypeVar("Result_co", covariant=True)

# A shorter time says nothing about the rest.
_LEAST_ELAPSED_S = 1.0
_MINUTE_S, _HOUR_S = 60, 3600


def never() -> bool:
    """Do not stop."""
    return False


def silent(done: int, total: int, text: str) -> None:
    """Show no progress."""


def stop_if(stop: Stop, text: str = "Stopped.") -> None:
    """Raise `skinsource.base.errors.Stopped` with ``text`` if ``stop`` returns True."""
    if stop():
        raise Stopped(text)


class Work(Protocol[Result_co]):
    """A function that can be the work of a job; its other arguments are already filled in."""

    def __call__(self, *, progress: Progress, stop: Stop) -> Result_co:
        """Do the work; raise `skinsource.base.errors.Stopped` once ``stop`` returns True."""


@dataclass(frozen=True, slots=True)
class Job(Generic[Result]):
    """Work that is started explicitly.

    Attributes
    ----------
    title
        What it does, for the user: "Exporting levels.csv".
    work
        Does it; ``functools.partial(install, folder)`` for instance.
    quick
        Whether it should not wait for long jobs.
    """

    title: str
    work: Work[Result]
    quick: bool = False

    def run(self, progress: Progress = silent, stop: Stop = never) -> Result:
        """Do the work in this thread.

        Raises
        ------
        Stopped
            ``stop`` returned True; nothing is left behind.
        Exception
            Whatever the work raises.
        """
        return self.work(progress=progress, stop=stop)


def seconds_left(done: int, total: int, elapsed_s: float) -> float | None:
    """Estimate how long a job will still take, in seconds; None while that is not known.

    Parameters
    ----------
    done, total
        Progress as given to `Progress`; a total of 0 is not known.
    elapsed_s
        How long it has run.
    """
    if done <= 0 or total <= 0 or elapsed_s < _LEAST_ELAPSED_S:
        return None
    return elapsed_s * max(total - done, 0) / done


def time_left_text(seconds: float | None) -> str:
    """Return a text such as "about 5 s left" or "about 3 min left"; empty for None.

    The time is rounded up to whole seconds below ten, to fives below a minute, to minutes and to
    half hours: nobody reads a number that changes all the time.
    """
    if seconds is None:
        return ""
    if seconds <= 10:
        return f"about {max(_rounded_up(seconds, 1), 1)} s left"
    if seconds <= _MINUTE_S - 5:
        return f"about {_rounded_up(seconds, 5)} s left"
    if seconds <= _HOUR_S - _MINUTE_S:
        return f"about {_rounded_up(seconds, _MINUTE_S) // _MINUTE_S} min left"
    return f"about {_rounded_up(seconds, _HOUR_S // 2) / _HOUR_S:g} h left"


def _rounded_up(seconds: float, step: int) -> int:
    return int(-(-seconds // step)) * step
