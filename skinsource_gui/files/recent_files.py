"""Files that were opened or saved lately."""

from pathlib import Path

from skinsource_gui.state.preferences import Preferences

#: So many are remembered.
MOST_RECENT = 10


class RecentFiles:
    """Paths of recent files, remembered between sessions."""

    def __init__(self, preferences: Preferences) -> None:
        self._preferences = preferences

    @property
    def paths(self) -> list[Path]:
        """Files that were opened or saved, newest first."""
        return [Path(name) for name in self._preferences.recent_names]

    def remember(self, path: Path) -> None:
        """Put a file at the front."""
        self._keep([path, *(known for known in self.paths if known != path)])

    def forget(self, path: Path) -> None:
        """Take a file out."""
        self._keep([known for known in self.paths if known != path])

    def _keep(self, paths: list[Path]) -> None:
        self._preferences.recent_names = [str(path) for path in paths[:MOST_RECENT]]
