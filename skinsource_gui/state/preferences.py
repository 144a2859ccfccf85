"""What the studio remembers between sessions: theme, window, recent files."""

import os
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

from PySide6.QtCore import QByteArray, QSettings

from skinsource.errors import SkinSourceError
from skinsource.files import is_folder, is_there, make_folder, read_bytes, write_bytes
from skinsource.files.assets import config_folder, user_folder

#: Unsaved work is kept as often, unless something else is wanted.
AUTOSAVE_S = 30.0

_LEAST_AUTOSAVE_S, _MOST_AUTOSAVE_S = 0.05, 3600.0
_NAME = "studio.ini"
_MOST_BYTES = 2**20


def settings_path() -> Path:
    """Where the settings lie: in the folder for settings.

    Older studios kept them beside the user's data; found there, they are moved.
    """
    path, before = config_folder() / _NAME, user_folder() / _NAME
    if is_there(path) or not is_there(before):
        return path
    try:
        make_folder(path.parent)
        write_bytes(path, read_bytes(before, most=_MOST_BYTES))
        before.unlink()
    except (SkinSourceError, OSError):
        # They stay where they are, and are read from there.
        return path if is_there(path) else before
    return path


class Preferences:
    """A small INI file.

    Parameters
    ----------
    path
        Where it lies; made when something is first remembered.
    """

    def __init__(self, path: Path):
        self._settings = QSettings(str(path), QSettings.Format.IniFormat)

    @property
    def theme_name(self) -> str:
        """``"light"``, ``"dark"``, or ``"system"``."""
        return str(self._settings.value("theme", "system"))

    @theme_name.setter
    def theme_name(self, name: str) -> None:
        self._settings.setValue("theme", name)

    @property
    def autosave_s(self) -> float:
        """Longest time for which unsaved work is not kept; SKINSOURCE_AUTOSAVE_S overrides it."""
        for value in (os.environ.get("SKINSOURCE_AUTOSAVE_S"), self._settings.value("autosave_s")):
            with suppress(TypeError, ValueError):
                seconds = float(value)
                if _LEAST_AUTOSAVE_S <= seconds <= _MOST_AUTOSAVE_S:
                    return seconds
        return AUTOSAVE_S

    @property
    def text_scale(self) -> float:
        """Size of words, 1 as the desktop has it."""
        try:
            return float(self._settings.value("text_scale", 1.0))
        except (TypeError, ValueError):
            return 1.0

    @text_scale.setter
    def text_scale(self, scale: float) -> None:
        self._settings.setValue("text_scale", scale)

    @property
    def geometry(self) -> QByteArray:
        """Place and size of the window; empty at first."""
        return self._bytes("geometry")

    @geometry.setter
    def geometry(self, geometry: QByteArray) -> None:
        self._settings.setValue("geometry", geometry)

    @property
    def screen(self) -> str:
        """The screen that place, size and arrangement belong to; empty at first."""
        return str(self._settings.value("screen", ""))

    @screen.setter
    def screen(self, words: str) -> None:
        self._settings.setValue("screen", words)

    @property
    def layout(self) -> QByteArray:
        """Arrangement of the docks; empty at first."""
        return self._bytes("layout")

    @layout.setter
    def layout(self, layout: QByteArray) -> None:
        self._settings.setValue("layout", layout)

    @property
    def arrangement(self) -> str:
        """The arrangement that was taken up last; empty at first."""
        return str(self._settings.value("arrangement", ""))

    @arrangement.setter
    def arrangement(self, name: str) -> None:
        self._settings.setValue("arrangement", name)

    @property
    def own_arrangements(self) -> dict[str, bytes]:
        """By the name of an arrangement, where the user's docks stand in it."""
        names = str(self._settings.value("own_arrangements", "")).split()
        found = {name: self._bytes(f"own_arrangement_{name}").data() for name in names}
        return {name: layout for name, layout in found.items() if layout}

    @own_arrangements.setter
    def own_arrangements(self, layouts: Mapping[str, bytes]) -> None:
        self._settings.setValue("own_arrangements", " ".join(layouts))
        for name, layout in layouts.items():
            self._settings.setValue(f"own_arrangement_{name}", QByteArray(layout))

    @property
    def recent_names(self) -> list[str]:
        """What is remembered of recent files, as they stand."""
        found = self._settings.value("recent", [])
        return [found] if isinstance(found, str) else list(found or [])

    @recent_names.setter
    def recent_names(self, names: list[str]) -> None:
        self._settings.setValue("recent", names)

    @property
    def folder(self) -> Path:
        """Where a file was last opened or written; the home folder at first."""
        known = Path(str(self._settings.value("folder", "")))
        try:
            return known if known.is_absolute() and is_folder(known) else Path.home()
        except SkinSourceError:  # it may not be searched
            return Path.home()

    @folder.setter
    def folder(self, folder: Path) -> None:
        self._settings.setValue("folder", str(folder))

    @property
    def output_text(self) -> str:
        """What this machine plays on, see `skinsource.playing.Output`; empty at first."""
        return str(self._settings.value("output", ""))

    @output_text.setter
    def output_text(self, text: str) -> None:
        self._settings.setValue("output", text)

    @property
    def rig_path(self) -> str:
        """Rig file of this machine; empty: none."""
        return str(self._settings.value("rig", ""))

    @rig_path.setter
    def rig_path(self, path: str) -> None:
        self._settings.setValue("rig", path)

    @property
    def export_text(self) -> str:
        """How a stimulus was exported last, see the page of stimuli; empty at first."""
        return str(self._settings.value("export", ""))

    @export_text.setter
    def export_text(self, text: str) -> None:
        self._settings.setValue("export", text)

    def flush(self) -> None:
        """Write what is remembered to disk."""
        self._settings.sync()

    def _bytes(self, key: str) -> QByteArray:
        value = self._settings.value(key, QByteArray())
        return value if isinstance(value, QByteArray) else QByteArray()
