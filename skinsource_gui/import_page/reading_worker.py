"""Reads one foreign file for a page."""

from functools import partial
from pathlib import Path
from time import monotonic

from PySide6.QtCore import QObject, Signal

from skinsource.base.errors import SkinSourceError, Stopped
from skinsource.base.job import Job, Progress, Stop, stop_if
from skinsource.design.recordings import (
    Found,
    ImportChoice,
    RawPart,
    Series,
    Taken,
    read_for,
    read_part,
)
from skinsource.readers.reading_process import ReadingProcess
from skinsource_gui.state.latest_wins import LatestWins

# What takes longer is given up for what is wanted meanwhile.
_PATIENCE_S = 0.5
_BETWEEN_PROGRESS_S = 0.05
# Stretches of the picture of all.
_COLUMNS = 600


class ReadingWorker(LatestWins):
    """Looks at a file, and takes parts of it; what need not be read again is not.

    What failed is an `ImportChoice`, or None while the file is looked at.

    Parameters
    ----------
    path
        The file.
    to_hz
        The rate of what is taken.
    """

    #: `Found`.
    looked = Signal(object)
    #: `RawPart`: what was read for the choice that is being worked on.
    read = Signal(object)
    #: `ImportChoice`, and its `Taken`.
    taken = Signal(object, object)
    #: Key of a series, and the least and largest of each stretch of it, (2, columns).
    surveyed = Signal(str, object)
    #: Samples read, and of how many.
    progressed = Signal(int, int)

    def __init__(self, path: Path, to_hz: float, parent: QObject | None = None) -> None:
        super().__init__("skinsource-import", parent)
        self._path, self._to_hz = path, to_hz
        self._process = ReadingProcess()
        self._found: Found | None = None
        self._raw: RawPart | None = None

    def look(self) -> None:
        """Find out what the file holds."""
        self.want(None, self._look)

    def take(self, choice: ImportChoice) -> None:
        """Take what ``choice`` means, instead of whatever was wanted before."""
        self.want(choice, partial(self._import, choice))

    def survey(self, series: Series) -> None:
        """Look at all of a series, once nothing else is wanted."""
        self.want_besides(partial(self._look_at_all, series))

    def close(self) -> None:
        super().close()
        self._process.close()

    def _look(self) -> None:
        self._found = self._process.look(self._path, stop=lambda: self.closed)
        self.tell(self.looked, self._found)

    def _import(self, choice: ImportChoice) -> None:
        job = Job(f"Importing {self._path.name}", partial(self._take, choice))
        self.tell(self.taken, choice, job.run(self._progress(), self._stop()))

    def _look_at_all(self, series: Series) -> None:
        try:
            extremes = self._process.overview(
                self._path, series.key, series.n_samples, _COLUMNS, stop=lambda: self.outdated
            )
        except SkinSourceError as error:
            if isinstance(error, Stopped):
                raise  # later, unless it is closed
            return  # what is wrong is said about the part
        self.tell(self.surveyed, series.key, extremes)

    def _take(self, choice: ImportChoice, *, progress: Progress, stop: Stop) -> Taken:
        if self._found is None:
            raise Stopped  # nothing is taken before it is known what there is
        if self._raw is None or self._raw.read_for != read_for(choice):
            self._raw = None
            self._raw = read_part(
                self._path,
                self._found,
                choice,
                process=self._process,
                progress=progress,
                stop=stop,
            )
        self.tell(self.read, self._raw)
        stop_if(stop)
        return self._raw.taken(choice, self._to_hz)

    def _stop(self) -> Stop:
        until_s = monotonic() + _PATIENCE_S

        def stop() -> bool:
            late = self.outdated and monotonic() > until_s
            return self.closed or late

        return stop

    def _progress(self) -> Progress:
        last_s = 0.0

        def tell(done: int, total: int, _: str) -> None:
            nonlocal last_s
            if monotonic() - last_s >= _BETWEEN_PROGRESS_S:
                last_s = monotonic()
                self.tell(self.progressed, done, total)

        return tell
