"""Renders a design without a screen: the window, the map and the traces as files."""

import sys
from pathlib import Path
from typing import Any

from PySide6.QtCore import QMessageLogContext, QtMsgType, qInstallMessageHandler

from skinsource.errors import SkinSourceError
from skinsource.export import export_levels, export_traces
from skinsource.files import make_folder
from skinsource_gui.shell.app import make_application, make_window
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.widgets.pictures.picture_file import save_picture

_SIZE_PX = (1600, 940)


def run(folder: Path, design: Path | None) -> int:
    """Write pictures and tables of ``design`` (or of the start design) to ``folder``."""
    qInstallMessageHandler(_tell)
    application = make_application()
    try:
        make_folder(folder)
        window = make_window(design, Preferences(folder / "studio.ini"))
        window.resize(*_SIZE_PX)
        window.show()
        window.do("arrange_design")
        application.processEvents()
        window.catch_up()
        application.processEvents()
        names = _write(window, folder)
        window.document.mark_saved(window.document.path)
        window.close()
    except SkinSourceError as error:
        sys.stderr.write(f"skinsource-gui: {error}\n")
        return 1
    (folder / "studio.ini").unlink(missing_ok=True)
    for name in names:
        sys.stdout.write(f"  {folder / name}\n")
    return 0


def _tell(_kind: QtMsgType, _context: QMessageLogContext, text: str) -> None:
    # What a platform without a screen cannot do is no news here.
    if not text.startswith("This plugin does not support"):
        sys.stderr.write(f"{text}\n")


def _write(window: MainWindow, folder: Path) -> list[str]:
    design, view = window.document.design, window.document.view
    save_picture(folder / "window.png", window.grab())
    skin: Any = window.panel("skin")
    save_picture(folder / "rms-map.png", skin.picture(800, 1200))
    export_levels(folder / "rms-map.csv", design, view)
    export_traces(folder / "traces.csv", design, view)
    return ["window.png", "rms-map.png", "rms-map.csv", "traces.csv"]
