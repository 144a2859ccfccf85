"""The folder of a sweep."""

import csv
import io
import json
from pathlib import Path

from skinsource.errors import StorageError
from skinsource.files import make_folder, named, write_bytes
from skinsource.keeping.lock import Lock
from skinsource.sweeps.journal import Journal
from skinsource.sweeps.ordering import Order, trials
from skinsource.sweeps.plan import Plan
from skinsource.sweeps.table import SweepTable, write_csv, write_parquet
from skinsource.version import __version__

#: What was measured so far; it stays, so that a sweep that is run again has nothing to do.
JOURNAL = "measured.jsonl"
TABLE, PARQUET, TRIALS, ABOUT = "stimuli.csv", "stimuli.parquet", "trials.csv", "sweep.json"


class Folder:
    """Where a sweep writes; one process at a time.

    Parameters
    ----------
    path
        It is made where it does not exist.
    digest
        Of the plan: a folder of another one is refused.

    Raises
    ------
    StorageError
        Another process runs a sweep there, or it cannot be written.
    InvalidInputError
        It holds another sweep.
    """

    def __init__(self, path: Path, digest: str) -> None:
        make_folder(path)
        self.path = path
        self._lock = Lock(path / JOURNAL)
        owner = self._lock.take()
        if owner is not None:
            raise StorageError(
                f"{named(path)}: another process ({owner.pid} on {owner.host}) runs a sweep "
                "there. Wait for its end, or choose another folder."
            )
        try:
            self.journal = Journal(path / JOURNAL, digest)
        except BaseException:
            self._lock.release()
            raise

    def __enter__(self) -> "Folder":
        return self

    def __exit__(self, *_: object) -> None:
        self.journal.close()
        self._lock.release()

    def finish(self, plan: Plan, table: SweepTable, order: Order | None, *, parquet: bool) -> None:
        """Write the tables, each whole or not at all."""
        write_csv(table, self.path / TABLE)
        if parquet:
            write_parquet(table, self.path / PARQUET)
        if order is not None:
            write_bytes(self.path / TRIALS, _trials_csv(order, table))
        about = {
            "stimuli": len(plan),
            "digest": plan.digest,
            "variables": {name: list(values) for name, values in plan.variables},
            "designs": [name for name, _ in plan.designs],
            "outputs": list(plan.outputs),
            "axes": plan.axes,
            "method": plan.method,
            "level": plan.level,
            "level_db": plan.level_db,
            "skinsource": __version__,
        }
        text = json.dumps(about, indent=2, ensure_ascii=False, allow_nan=False)
        write_bytes(self.path / ABOUT, text.encode() + b"\n")


def _trials_csv(order: Order, table: SweepTable) -> bytes:
    """Trials of the stimuli that there are: those that could not be measured are left out."""
    failed = table.failed
    stimuli = [number for row in table.rows if (number := int(row[0])) not in failed]
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("participant", "block", "trial", "stimulus"))
    writer.writerows(
        (one.participant, one.block, one.trial, one.stimulus) for one in trials(order, stimuli)
    )
    return text.getvalue().encode()
