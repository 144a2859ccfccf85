"""Measurement of stimuli on the machines of a Dask cluster (extra ``cluster``)."""

from collections.abc import Iterable, Iterator
from functools import partial
from typing import Any

from skinsource.base.errors import SkinSourceError
from skinsource.base.extras import package_of_extra
from skinsource.base.job import Stop
from skinsource.base.quoting import printable, quoted
from skinsource.studies.sweeps.plan import Plan, chunks
from skinsource.studies.sweeps.workers import Row, measure, prepare, rows_of

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
