"""What a panel is told, and who hears it, when it is made."""

from collections.abc import Callable, Mapping

from skinsource_gui.files.file_actions import FileActions
from skinsource_gui.panel import PREPARING, Panel
from skinsource_gui.shell.docks.dock import Dock
from skinsource_gui.state.preferences import Preferences


class TakingIn:
    """Takes each panel into the window, after all others have met it.

    Parameters
    ----------
    docks
        By the name of their panel: where it goes.
    do, complain, report
        Does what the table of actions calls by a name; says what went wrong, and what was done.
    files, preferences
        Who hears of files that are written; folder and colours that it is told.
    """

    def __init__(
        self,
        docks: Mapping[str, Dock],
        do: Callable[[str], None],
        complain: Callable[[str], None],
        report: Callable[[str], None],
        files: FileActions,
        preferences: Preferences,
    ) -> None:
        self._docks, self._do, self._complain, self._report = docks, do, complain, report
        self._files, self._preferences = files, preferences

    def __call__(self, panel: Panel) -> None:
        """Take in a panel."""
        panel.action_wanted.connect(self._do)
        panel.failed.connect(self._complain)
        panel.done.connect(self._report)
        panel.written.connect(self._files.note_written)
        self._files.folder_changed.connect(panel.show_folder)
        panel.show_folder(self._preferences.folder)
        if panel.needs:
            panel.show_problem(PREPARING)
        self._docks[panel.name].hold(panel)
