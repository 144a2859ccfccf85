"""Measurement of stimuli on all cores, or on the machines of a Dask cluster (extra ``cluster``).

A stimulus that ends its process costs its own row alone: those that were under way when a process
ended are measured again, one by one.
"""

import gc
import signal
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Future, wait
from functools import partial
from importlib import import_module
from itertools import islice
from threading import local
from typing import Any

from skinsource.base.allocation import keep_freed_memory
from skinsource.base.errors import SkinSourceError, StorageError, printable, quoted
from skinsource.base.extras import package_of_extra
from skinsource.base.job import Stop, never, stop_if
from skinsource.studies.sweeps.measuring import Measurer, Metrics, metrics_or_reason
from skinsource.studies.sweeps.plan import Plan, chunks

#: Number of a stimulus, and its metrics or the reason why it has none.
Row = tuple[int, Metrics | str]

_POLL_S = 0.05
#: Stimuli that are under way for each process: being measured, or next.
_UNDER_WAY = 4
# Processes whose program was killed end after this time.
_IDLE_S = 20
_ENVIRONMENT = {
    # They import no module from the current folder.
    "PYTHONSAFEPATH": "1",
    # Every core has a process already.
    "OPENBLAS_NUM_THREADS": "1",
    # Remembered spectra are no leak.
    "LOKY_MAX_MEMORY_LEAK_SIZE": "1e15",
}


def measured(
    plan: Plan, numbers: Iterable[int], processes: int, stop: Stop = never
) -> Iterator[Row]:
    """Yield the metrics, or errors, of some stimuli of ``plan``, in any order.

    Raises
    ------
    Stopped
        ``stop`` said so; the processes have ended.
    StorageError
        No process can be started.
    """
    remaining = dict.fromkeys(numbers)
    suspects: list[int] = []
    while remaining:
        count = 1 if suspects else min(max(processes, 1), len(remaining))
        under_way = 1 if suspects else _UNDER_WAY * count
        pool = _pool(plan, count)
        pieces = ((number,) for number in suspects or list(remaining))
        try:
            for number, outcome in rows_of(partial(pool.submit, measure), pieces, under_way, stop):
                del remaining[number]
                yield number, outcome
            suspects = []
        except BrokenExecutor:
            unfinished = [number for number in suspects or remaining if number in remaining]
            if suspects:
                del remaining[unfinished[0]]
                yield unfinished[0], "the process that predicted it ended, twice"
                suspects = unfinished[1:]
            else:
                suspects = unfinished[:under_way]
        except OSError as error:
            raise StorageError(
                f"the sweep cannot start another process ({error.strerror or error}). Close other "
                "programs, or run it with one process."
            ) from error
        finally:
            pool.shutdown(kill_workers=True)


def rows_of(
    submit: Callable[[tuple[int, ...]], "Future[list[Row]]"],
    pieces: Iterable[tuple[int, ...]],
    under_way: int,
    stop: Stop,
) -> Iterator[Row]:
    """Yield the rows of pieces of a sweep as they are done.

    Parameters
    ----------
    submit
        Has a piece measured elsewhere.
    under_way
        How many pieces are submitted at a time.
    """
    waiting = iter(pieces)
    running: set[Future[list[Row]]] = set()
    while running := running | {
        submit(piece) for piece in islice(waiting, under_way - len(running))
    }:
        stop_if(stop)
        done, running = wait(running, _POLL_S, FIRST_COMPLETED)
        for future in done:
            yield from future.result()


def _pool(plan: Plan, processes: int) -> Any:
    """Return a pool whose processes do not run the script of the caller again."""
    # Importing it takes longer than most commands.
    loky: Any = import_module("loky")
    return loky.ProcessPoolExecutor(
        processes,
        timeout=_IDLE_S,
        initializer=_begin,
        initargs=(plan, plan.digest),
        env=_ENVIRONMENT,
    )


def _begin(plan: Plan, digest: str) -> None:
    # Ctrl-C goes to the whole group of processes; the first one ends the others.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    keep_freed_memory()
    # Modules stay: a garbage collection through them takes as long as a hundred stimuli.
    gc.freeze()
    prepare(plan, digest)


_thread = local()


def prepare(plan: Plan, digest: str) -> None:
    """Make this thread measure stimuli of a plan with this digest."""
    if getattr(_thread, "digest", None) != digest:
        _thread.measurer = Measurer(plan)
        _thread.digest = digest


def measure(numbers: tuple[int, ...]) -> list[Row]:
    """Measure stimuli of the plan that was prepared."""
    return [(number, metrics_or_reason(_thread.measurer, number)) for number in numbers]


#: Chunks that wait at the scheduler for each thread that measures.
_CHUNKS_PER_THREAD = 3
_CONNECT_S = 30
# A chunk is given up when so many machines were lost while they did it.
_RETRIES = 5


class ClusterError(SkinSourceError):
    """The cluster cannot be reached, or lost a piece of the work too often."""


class Cluster:
    """The workers of a Dask scheduler, for the parameter ``measuring`` of `running.run`.

    Parameters
    ----------
    address
        Address of the scheduler: ``"tcp://host:8786"``.

    Raises
    ------
    MissingExtraError
        The package ``distributed`` is not installed.
    """

    def __init__(self, address: str) -> None:
        self._distributed: Any = package_of_extra("distributed", "cluster")
        self._address = address

    def __call__(self, plan: Plan, numbers: Iterable[int], stop: Stop) -> Iterator[Row]:
        """Yield the metrics, or errors, of some stimuli of ``plan``, in any order.

        Raises
        ------
        ClusterError
            The scheduler does not answer, or a piece of the work was lost again and again.
        Stopped
            ``stop`` said so; pending work is cancelled.
        """
        with self._client() as client:
            # Not pure: a later sweep of the same plan is measured again.
            executor = client.get_executor(pure=False, retries=_RETRIES)
            submit = partial(executor.submit, measure_chunk, plan, plan.digest)
            under_way = _CHUNKS_PER_THREAD * max(sum(client.nthreads().values()), 1)
            try:
                yield from rows_of(submit, chunks(numbers), under_way, stop)
            except SkinSourceError:
                raise
            except Exception as error:  # whatever a worker, or the way to it, may raise
                raise ClusterError(
                    f"a piece of the sweep was lost on the cluster ({printable(error)}). Check its "
                    "workers, then run the sweep again: it continues where it stopped."
                ) from error
            finally:
                executor.shutdown(wait=False)

    def _client(self) -> Any:
        try:
            return self._distributed.Client(self._address, timeout=_CONNECT_S, set_as_default=False)
        except (OSError, ValueError, TypeError) as error:
            raise ClusterError(
                f"the scheduler {quoted(self._address)} does not respond ({printable(error)}). "
                "Check its address, such as tcp://host:8786, and that it runs."
            ) from error


def measure_chunk(plan: Plan, digest: str, numbers: tuple[int, ...]) -> list[Row]:
    """Measure on a worker; each of its threads has a measurer for the plan."""
    prepare(plan, digest)
    return measure(numbers)
