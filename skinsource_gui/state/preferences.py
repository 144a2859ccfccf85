"""Settings that are stored between sessions, the first design, and the installed limbs."""

import os
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, Generic, TypeVar

from PySide6 import QtWidgets
from PySide6.QtCore import QByteArray, QEvent, QObject, QSettings, Signal

from skinsource.base.assets import config_folder
from skinsource.base.errors import SkinSourceError
from skinsource.base.files import is_folder
from skinsource.design.design import Design, track
from skinsource.design.waveforms.tones import Tone
from skinsource.limbs.catalog import available_limbs
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.qt.windows import WindowEvents
from skinsource_gui.state.document import Document

#: Unsaved work is kept as often, unless something else is wanted.
AUTOSAVE_S = 30.0

_LEAST_AUTOSAVE_S, _MOST_AUTOSAVE_S = 0.05, 3600.0
_NAME = "studio.ini"
#: Number of recent files that are remembered.
MOST_RECENT = 10
Value = TypeVar("Value")


def settings_path() -> Path:
    """Where the settings lie: in the folder for settings."""
    return config_folder() / _NAME


class _Kept(Generic[Value]):
    """What `Preferences` remember under a key.

    Parameters
    ----------
    key, usual
        Its name in the file, and what it is while nothing is remembered, or nothing readable.
    read
        Returns it, given what the file has.
    """

    def __init__(self, key: str, usual: Value, read: Callable[[Any], Value]) -> None:
        self._key, self._usual, self._read = key, usual, read

    def __get__(self, owner: "Preferences", _kind: type) -> Value:
        with suppress(TypeError, ValueError):
            return self._read(owner.settings.value(self._key, self._usual))
        return self._usual

    def __set__(self, owner: "Preferences", value: Value) -> None:
        owner.settings.setValue(self._key, value)


def _bytes(value: object) -> QByteArray:
    return value if isinstance(value, QByteArray) else QByteArray()


def _names(value: object) -> list[str]:
    # One name is stored as a text.
    names = value if isinstance(value, list) else [value] if isinstance(value, str) else []
    return [str(name) for name in names]


class Preferences:
    """A small INI file.

    Parameters
    ----------
    path
        Where it lies; made when something is first remembered.

    Attributes
    ----------
    settings
        What is remembered, by key.
    """

    #: ``"light"``, ``"dark"``, or ``"system"``.
    theme_name = _Kept("theme", "system", str)
    #: The screen that place, size and arrangement belong to; empty at first.
    screen = _Kept("screen", "", str)
    #: The arrangement that was taken up last; empty at first.
    arrangement = _Kept("arrangement", "", str)
    #: What this machine plays on, see `skinsource.lab.playing.devices.Output`; empty at first.
    output_text = _Kept("output", "", str)
    #: Rig file of this machine; empty: none.
    rig_path = _Kept("rig", "", str)
    #: Whether the stand-in person was chosen in place of the rig.
    stand_in = _Kept("stand_in", False, lambda value: str(value).lower() == "true")
    #: The accelerometer that actuators are measured with, and the sweep; empty at first.
    sensor_text = _Kept("sensor", "", str)
    #: How a stimulus was exported last, see the page of stimuli; empty at first.
    export_text = _Kept("export", "", str)
    #: Size of words, 1 as the desktop has it.
    text_scale = _Kept("text_scale", 1.0, float)
    #: Whether the hints of the first start were shown.
    hinted = _Kept("hinted", False, lambda value: str(value).lower() == "true")
    #: Place and size of the window; empty at first.
    geometry = _Kept("geometry", QByteArray(), _bytes)
    #: Paths of files that were opened or saved, newest first.
    recent_names = _Kept("recent", list[str](), _names)

    def __init__(self, path: Path):
        self.settings = QSettings(str(path), QSettings.Format.IniFormat)

    @property
    def autosave_s(self) -> float:
        """Longest time for which unsaved work is not kept; SKINSOURCE_AUTOSAVE_S overrides it."""
        for value in (os.environ.get("SKINSOURCE_AUTOSAVE_S"), self.settings.value("autosave_s")):
            with suppress(ValueError):
                seconds = float(str(value))
                if _LEAST_AUTOSAVE_S <= seconds <= _MOST_AUTOSAVE_S:
                    return seconds
        return AUTOSAVE_S

    @property
    def own_arrangements(self) -> dict[str, bytes]:
        """By the name of an arrangement, where the user's docks stand in it."""
        names = str(self.settings.value("own_arrangements", "")).split()
        layouts = {
            name: bytes(_bytes(self.settings.value(f"own_arrangement_{name}")).data())
            for name in names
        }
        return {name: layout for name, layout in layouts.items() if layout}

    @own_arrangements.setter
    def own_arrangements(self, layouts: Mapping[str, bytes]) -> None:
        self.settings.setValue("own_arrangements", " ".join(layouts))
        for name, layout in layouts.items():
            self.settings.setValue(f"own_arrangement_{name}", QByteArray(layout))

    @property
    def folder(self) -> Path:
        """Where a file was last opened or written; the home folder at first."""
        known = Path(str(self.settings.value("folder", "")))
        try:
            return known if known.is_absolute() and is_folder(known) else Path.home()
        except SkinSourceError:  # it may not be searched
            return Path.home()

    @folder.setter
    def folder(self, folder: Path) -> None:
        self.settings.setValue("folder", str(folder))

    def note_recent(self, path: Path, *, there: bool = True) -> None:
        """Put a file at the front of the recent ones, or remove one that is not ``there``."""
        others = [name for name in self.recent_names if name != str(path)]
        self.recent_names = [str(path), *others][:MOST_RECENT] if there else others

    def flush(self) -> None:
        """Write what is remembered to disk."""
        self.settings.sync()


def start_design(limb: str) -> Design:
    """Design of the first window: a 100 Hz tone on the pad of digit II (input 7)."""
    return Design(limb=limb, inputs=(track(7, Tone(frequency_hz=100.0)),))


#: Titles of the jobs that install limbs: from a folder, and by download.
INSTALLATIONS = ("Installing the measured limbs", "Downloading the measured limbs")


class InstalledLimbs(QObject):
    """Looks again when the user comes back to the window, perhaps from an installation.

    And when a design is shown whose limb was not there: its file may have come back since.

    Parameters
    ----------
    names
        The limbs there are at the start.
    document
        Whose design that is.
    window
        Looks whenever this becomes the active window; also the parent.
    """

    #: Limbs came or went.
    changed = Signal()

    def __init__(
        self, names: tuple[str, ...], document: Document, window: QtWidgets.QWidget
    ) -> None:
        super().__init__(window)
        self.names = names
        # A limb may be imported anew, or mirrored, under its name.
        self._shown = tuple(facts_of(name) for name in names)
        self._document = document
        document.changed.connect(self._follow)
        WindowEvents.follow(window, lambda _: self.look(), QEvent.Type.WindowActivate)

    def _follow(self) -> None:
        if self._document.design.limb not in self.names:
            self.look()

    def look(self) -> None:
        """Look up which limbs are installed now."""
        limbs = available_limbs()
        shown = tuple(facts_of(name) for name in limbs)
        if shown != self._shown:
            self.names, self._shown = limbs, shown
            self.changed.emit()
