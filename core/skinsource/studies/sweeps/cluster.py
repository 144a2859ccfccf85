"""Measurement of stimuli on the machines of a Dask cluster (extra ``cluster``)."""

from collections.abc import Iterable, Iterator
from itertools import islice
from threading import local
from typing import Any

from skinsource.base.errors import MissingExtraError, SkinSourceError
from skinsource.base.extras import package_of_extra
from skinsource.base.job import Stop, stop_if
from skinsource.base.quoting import printable, quoted
from skinsource.studies.sweeps.measuring import Measurer, metrics_or_reason
from skinsource.studies.sweeps.metrics import Metrics
from skinsource.studies.sweeps.plan import Plan, chunks, plan_of
from skinsource.studies.sweeps.workers import Row

#: Chunks that wait at the scheduler for each thread that measures.
_CHUNKS_PER_THREAD = 3
_CONNECT_S = 30
# A chunk is given up when so many machines were lost while they did it.
_RETRIES = 5
_POLL_S = 0.5


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
            yield from self._measured(client, plan, numbers, stop)

    def _client(self) -> Any:
        try:
            return self._distributed.Client(self._address, timeout=_CONNECT_S, set_as_default=False)
        except (OSError, ValueError, TypeError) as error:
            raise ClusterError(
                f"the scheduler {quoted(self._address)} does not answer ({printable(error)}). "
                "Check its address, such as tcp://host:8786, and that it runs."
            ) from error

    def _measured(
        self, client: Any, plan: Plan, numbers: Iterable[int], stop: Stop
    ) -> Iterator[Row]:
        text, digest = plan.text, plan.digest
        waiting = chunks(numbers)

        def submitted(chunk: tuple[int, ...]) -> Any:
            # Not pure: a later sweep of the same plan is measured again.
            return client.submit(measure_chunk, text, digest, chunk, pure=False, retries=_RETRIES)

        n_threads = max(sum(client.nthreads().values()), 1)
        running = {submitted(chunk) for chunk in islice(waiting, _CHUNKS_PER_THREAD * n_threads)}
        try:
            while running:
                stop_if(stop)
                done = self._some(client, running)
                running -= done
                running |= {submitted(chunk) for chunk in islice(waiting, len(done))}
                for future in done:
                    yield from _rows(future)
        finally:
            client.cancel(list(running), force=True)

    def _some(self, client: Any, running: set[Any]) -> set[Any]:
        """Return the futures that are done; after a while, none."""
        try:
            with client.as_current():
                result = self._distributed.wait(
                    list(running), timeout=_POLL_S, return_when="FIRST_COMPLETED"
                )
        except TimeoutError:
            return set()
        return set(result.done)


_thread_state = local()


def measure_chunk(text: str, digest: str, numbers: tuple[int, ...]) -> list[Row]:
    """Measure on a worker; each of its threads has a measurer for the plan."""
    cached: tuple[str, Measurer] | None = getattr(_thread_state, "measurer", None)
    if cached is None or cached[0] != digest:
        cached = _thread_state.measurer = (digest, Measurer(plan_of(text)))
    return [(number, metrics_or_reason(cached[1], number)) for number in numbers]


def _rows(future: Any) -> list[tuple[int, Metrics | str]]:
    try:
        rows: list[Row] = future.result()
    except (MissingExtraError, SkinSourceError):
        raise
    except Exception as error:  # whatever a worker, or the way to it, may raise
        raise ClusterError(
            f"a piece of the sweep was lost on the cluster ({printable(error)}). Look at its "
            "workers, then run the sweep again: it goes on where it ended."
        ) from error
    return rows
