"""Jobs away from the GUI thread: long ones one after another, and quick ones beside them.

`PageJobs` follows the jobs of one page, `Levelling` edits wavelets and tracks after their
prediction.
"""

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain
from threading import Event
from time import perf_counter
from typing import Any

from PySide6.QtCore import QObject, Signal

from skinsource.base.errors import Stopped
from skinsource.base.job import Job, Progress, Stop, seconds_left
from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design, View
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from skinsource.engine.levelling import MEASURE, track_levels_db, wavelet_levels_db
from skinsource_gui.state.document import Document
from skinsource_gui.state.worker import Worker, fault_text

# Progress that changes faster cannot be seen.
_PROGRESS_INTERVAL_S = 0.05


@dataclass(frozen=True, slots=True)
class JobProgress:
    """How far a job is.

    Attributes
    ----------
    done, total
        Pieces of work; a total of 0 while that is not known.
    text
        What is being done.
    elapsed_s
        How long the job has run.
    """

    done: int = 0
    total: int = 0
    text: str = ""
    elapsed_s: float = 0.0

    @property
    def seconds_left(self) -> float | None:
        """The time that is left; None while it is not known."""
        return seconds_left(self.done, self.total, self.elapsed_s)


class _Lane:
    """Jobs one after another in a thread."""

    def __init__(self, name: str, parent: QObject) -> None:
        self.waiting: deque[Job[Any]] = deque()
        # It is cleared away, if it is not `current`.
        self.running: Job[Any] | None = None
        self.current: Job[Any] | None = None
        self.stop = Event()
        self.worker = Worker(name, parent)


class JobRunner(QObject):
    """Runs jobs in the order in which they were added; quick ones do not wait for long ones."""

    #: A job begins once this returns.
    starting = Signal()
    #: Another job runs, or none, or other jobs wait.
    changed = Signal()
    #: The `current` job, and its `JobProgress`.
    progressed = Signal(object, object)
    #: The job that is finished, and its result.
    done = Signal(object, object)
    #: The job that was cancelled.
    cancelled = Signal(object)
    #: The job that failed, and the error.
    failed = Signal(object, object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._ends: dict[Job[Any], dict[str, Callable[..., object]]] = {}
        # That of long jobs, and that of quick ones.
        self._lanes = _Lane("skinsource-job", self), _Lane("skinsource-quick-job", self)

    @property
    def current(self) -> Job[Any] | None:
        """The running job, a quick one before a long one."""
        return self._lanes[True].current or self._lanes[False].current

    @property
    def busy(self) -> bool:
        """Whether a job runs, is cleared away, or waits."""
        return any(lane.running for lane in self._lanes)

    @property
    def unfinished(self) -> tuple[Job[Any], ...]:
        """The running jobs, and those that wait; empty after `close`."""
        if self._lanes[0].worker.closed:
            return ()
        jobs = ((lane.current, *lane.waiting) for lane in reversed(self._lanes))
        return tuple(filter(None, chain(*jobs)))

    def add(self, job: Job[Any], **ends: Callable[..., object]) -> Job[Any] | None:
        """Run ``job`` after those that were added before, and return the one it waits for, if any.

        ``ends``: called with what the signal of this name tells besides the job.
        """
        lane = self._lanes[job.quick]
        before = lane.waiting[-1] if lane.waiting else lane.running
        lane.waiting.append(job)
        self._ends[job] = ends
        if before is None:
            self._start_next(lane)
        else:
            self.changed.emit()
        return before

    def cancel(self, job: Job[Any] | None = None) -> None:
        """Stop ``job``, or the `current` one; the next one begins."""
        job = job or self.current
        if job is None:
            return
        lane = self._lanes[job.quick]
        if job is lane.current:
            lane.stop.set()
        elif job in lane.waiting:
            lane.waiting.remove(job)
            self.changed.emit()
            self._end(job, "cancelled")

    def close(self) -> None:
        """Drop all jobs, stop the running ones, and wait until they are cleared away."""
        for lane in self._lanes:
            lane.waiting.clear()
            lane.stop.set()
            lane.worker.close()

    def _start_next(self, lane: _Lane) -> None:
        lane.running = lane.current = lane.waiting.popleft() if lane.waiting else None
        if lane.running is not None:
            self.starting.emit()
            # A new event: the thread may still check that of the job before.
            lane.stop = Event()
            job = lane.running
            work = partial(job.run, self._progress_of(job, lane), self._stop_of(job, lane))
            lane.worker.run(work, partial(self._receive, job, lane))
        self.changed.emit()

    def _progress_of(self, job: Job[Any], lane: _Lane) -> Progress:
        start_s, last_s = perf_counter(), 0.0

        def tell(done: int, total: int, text: str) -> None:
            nonlocal last_s
            now_s = perf_counter()
            if not total or now_s - last_s >= _PROGRESS_INTERVAL_S:
                last_s = now_s
                progress = JobProgress(done, total, text, now_s - start_s)
                lane.worker.tell(self._tell, job, progress)

        return tell

    def _stop_of(self, job: Job[Any], lane: _Lane) -> Stop:
        stop, is_stopping = lane.stop, False

        def should_stop() -> bool:
            nonlocal is_stopping
            if stop.is_set() and not is_stopping:
                # From here on nothing is written.  To clear away may take longer than the user
                # should have to wait.
                is_stopping = True
                lane.worker.tell(self._note_stopping, job, lane)
            return is_stopping

        return should_stop

    def _tell(self, job: Job[Any], progress: JobProgress) -> None:
        if job is self.current:
            self.progressed.emit(job, progress)

    def _note_stopping(self, job: Job[Any], lane: _Lane) -> None:
        if job is lane.current:
            lane.current = None
            self.changed.emit()
            self._end(job, "cancelled")

    def _receive(self, job: Job[Any], lane: _Lane, result: object, error: Exception | None) -> None:
        was_cancelled = lane.current is not job
        self._start_next(lane)
        if was_cancelled:
            return
        if error is None:
            self._end(job, "done", result)
        elif isinstance(error, Stopped):
            self._end(job, "cancelled")
        else:
            self._end(job, "failed", error)

    def _end(self, job: Job[Any], how: str, *what: object) -> None:
        getattr(self, how).emit(job, *what)
        call = self._ends.pop(job).get(how)
        if call is not None:
            call(*what)


class PageJobs(QObject):
    """Adds the jobs of a page to the runner, and emits what becomes of them, and of no others.

    Parameters
    ----------
    runner
        Runs the jobs.
    titles
        Titles of unfinished jobs that belong to the page too: an earlier one began them.
    """

    #: The `Job`, and its `JobProgress`.
    progressed = Signal(object, object)
    #: A job was added, or has ended.
    changed = Signal()
    #: The `Job`, and its result.
    done = Signal(object, object)
    #: Why a job failed.
    failed = Signal(str)
    #: A job was cancelled.
    cancelled = Signal()

    def __init__(self, runner: JobRunner, parent: QObject, titles: Sequence[str] = ()) -> None:
        super().__init__(parent)
        self._runner = runner
        self._jobs = [job for job in runner.unfinished if job.title in titles]
        runner.progressed.connect(self._note_progress)
        runner.done.connect(self._note_done)
        runner.failed.connect(self._note_failed)
        runner.cancelled.connect(self._note_cancelled)

    @property
    def busy(self) -> bool:
        """Whether a job is not finished."""
        return bool(self._jobs)

    def add(self, job: Job[Any]) -> None:
        """Run a job after those that were added before."""
        self._jobs.append(job)
        self.changed.emit()
        self._runner.add(job)

    def cancel(self) -> None:
        """Cancel all jobs of the page."""
        for job in tuple(self._jobs):
            self._runner.cancel(job)

    def give_up(self) -> None:
        """Cancel all jobs of the page; no more signals are emitted for them."""
        jobs, self._jobs = self._jobs, []
        for job in jobs:
            self._runner.cancel(job)
        self.changed.emit()

    def _note_progress(self, job: Job[Any], progress: JobProgress) -> None:
        if job in self._jobs:
            self.progressed.emit(job, progress)

    def _note_done(self, job: Job[Any], result: object) -> None:
        if self._has_ended(job):
            self.done.emit(job, result)

    def _note_failed(self, job: Job[Any], error: Exception) -> None:
        if self._has_ended(job):
            self.failed.emit(fault_text(error))

    def _note_cancelled(self, job: Job[Any]) -> None:
        if self._has_ended(job):
            self.cancelled.emit()

    def _has_ended(self, job: Job[Any]) -> bool:
        if job not in self._jobs:
            return False
        self._jobs.remove(job)
        self.changed.emit()
        return True


_CHANGED = "The design has changed meanwhile; try again."


class Levelling(QObject):
    """Makes wavelets of a train, or tracks, equally strong on the skin.

    They are predicted in a job; the edit follows.
    """

    #: Why they were not levelled.
    failed = Signal(str)

    def __init__(self, document: Document, runner: JobRunner, parent: QObject) -> None:
        super().__init__(parent)
        self._document, self._runner = document, runner

    def equalise(self) -> None:
        """Predict each wavelet of the selected trains alone, then edit their gains."""
        design = self._document.design
        ids = [clip.id for clip in selected_trains(design, self._document.view)]

        def predict(**job: Any) -> list[tuple[float, ...]]:
            return [wavelet_levels_db(design, id, **job) for id in ids]

        def edit(of: Design, view: View, levels: list[tuple[float, ...]]) -> Edit | Refusal:
            done = Edit(label="", design=of, view=view)
            for id, levels_db in zip(ids, levels, strict=True):
                outcome = edits.equalise_on_skin(done.design, done.view, id, levels_db, MEASURE)
                if isinstance(outcome, Refusal):
                    return outcome
                done = outcome
            if len(ids) == 1:
                return done
            said = f"Balanced {len(ids)} clips by the {MEASURE}, on {of.limb}"
            return replace(done, label=f"Balance wavelets of {len(ids)} clips", said=said)

        self._run(Job("Balancing wavelets", predict, quick=True), edit)

    def match_tracks(self) -> None:
        """Predict each selected track alone, then edit their amplitudes."""
        design = self._document.design
        ids = tuple(id for id in self._document.view.selected_inputs if id in design.ids)
        job = Job("Matching inputs", partial(track_levels_db, design, ids), quick=True)
        self._run(job, edits.match_tracks)

    def _run(self, job: Job[Any], edit: Callable[[Design, View, Any], Edit | Refusal]) -> None:
        """Edit the design by the levels that are predicted, unless it has changed meanwhile."""
        predicted, document = self._document.design, self._document

        def apply(levels: object) -> None:
            if document.design is predicted:
                document.apply(edit(predicted, document.view, levels))
            else:
                self.failed.emit(_CHANGED)

        self._runner.add(job, done=apply, failed=lambda error: self.failed.emit(str(error)))


def selected_trains(design: Design, view: View) -> list[Clip]:
    """Return the selected clips that play a wavelet train."""
    chosen = [clip for clip in design.clips if clip.id in view.selected_clips]
    return [clip for clip in chosen if isinstance(clip.waveform, WaveletTrain)]
