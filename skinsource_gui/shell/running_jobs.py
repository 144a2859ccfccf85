"""The long jobs of one window: cancelling them, and closing while they run."""

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QWidget

from skinsource_gui.state.job_runner import JobRunner
from skinsource_gui.widgets.asking import agreed


class RunningJobs(QObject):
    """Cancels what runs, and asks before the window takes it along.

    Parameters
    ----------
    runner
        Carries the jobs out.
    window
        In front of which questions are asked; also the parent.
    """

    #: Whether there is something to cancel.
    can_cancel = Signal(bool)

    def __init__(self, runner: JobRunner, window: QWidget) -> None:
        super().__init__(window)
        self._runner, self._window = runner, window
        self._ended = False
        runner.changed.connect(self._tell)

    def show_on(self, cancel: QAction) -> None:
        """Let that action be chosen only while there is something to cancel."""
        cancel.setEnabled(self._runner.current is not None)
        self.can_cancel.connect(cancel.setEnabled)

    def cancel(self) -> None:
        """Stop the job that is being carried out; the next one begins."""
        self._runner.cancel()

    def may_close(self) -> bool:
        """Whether the window may go: nothing is being done, or the user gives it up."""
        titles = "; ".join(job.title for job in self._runner.unfinished)
        if not titles or self._ended:
            return True
        question = f"Not finished yet: {titles}. Stop it and close? Nothing half done is left."
        return agreed(self._window, "Something is running", question)

    def end(self) -> None:
        """Stop all for good; nothing unfinished is left."""
        self._ended = True
        if self._runner.busy:
            # To clear away a gigabyte can take a second.
            self._window.hide()
        self._runner.close()

    def _tell(self) -> None:
        self.can_cancel.emit(self._runner.current is not None)
