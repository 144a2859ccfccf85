"""Measures stimuli in this process; one that cannot be measured does not end the sweep."""

from collections.abc import Iterable, Iterator

from skinsource.errors import SkinSourceError, Stopped
from skinsource.job import Stop, never, stop_if
from skinsource.quoting import sentence
from skinsource.sweeps.measuring import Measurer, Metrics
from skinsource.sweeps.plan import Plan


def found_of(measurer: Measurer, number: int, stop: Stop = never) -> Metrics | str:
    """Metrics of a stimulus, or the sentence that says why it has none."""
    try:
        return measurer.measure(number, stop)
    except Stopped:
        raise
    except SkinSourceError as error:
        return sentence(str(error))
    except MemoryError:
        return "it needs more memory than there is."


def measured_here(
    plan: Plan, numbers: Iterable[int], stop: Stop = never
) -> Iterator[tuple[int, Metrics | str]]:
    """Give what is found of some stimuli of ``plan``, one after the other, by this thread."""
    measurer = Measurer(plan)
    for number in numbers:
        stop_if(stop)
        yield number, found_of(measurer, number, stop)
