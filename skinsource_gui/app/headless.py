"""Renders a design without a screen: the window, the map and the traces as files."""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from PySide6 import QtWidgets
from PySide6.QtCore import QMessageLogContext, QtMsgType, qInstallMessageHandler

from skinsource.base.errors import SkinSourceError
from skinsource.base.files import make_folder, write_bytes
from skinsource.design.design_file import open_design
from skinsource.export.tables import export_levels, export_traces
from skinsource_gui.app.app import make_application, make_window
from skinsource_gui.plots.pictures import save_picture
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import Preferences

_SIZE_PX = (1600, 940)


def run(folder: Path, design: Path | None) -> int:
    """Write pictures and tables of ``design`` (or of the start design) to ``folder``.

    Nothing is written there unless all of them could be made.
    """
    qInstallMessageHandler(_tell)
    application = make_application()
    try:
        with TemporaryDirectory(prefix="skinsource-") as name:
            files = _render(application, design, Path(name))
            make_folder(folder)
            for file in files:
                write_bytes(folder / file.name, file.read_bytes())
                sys.stdout.write(f"  {folder / file.name}\n")
    except SkinSourceError as error:
        sys.stderr.write(f"skinsource-gui: {error}\n")
        return 1
    return 0


def _render(application: QtWidgets.QApplication, design: Path | None, folder: Path) -> list[Path]:
    if design is not None:
        # Where that fails, the window shows the start design.
        open_design(design)
    preferences = Preferences(folder / "studio.ini")
    window = make_window(design, preferences)
    try:
        window.resize(*_SIZE_PX)
        window.show()
        window.do("arrange_design")
        application.processEvents()
        window.catch_up()
        application.processEvents()
        return _write(window, folder)
    finally:
        window.document.mark_saved(window.document.path)
        window.close()
        preferences.flush()


def _tell(_kind: QtMsgType, _context: QMessageLogContext, text: str) -> None:
    # What a platform without a screen cannot do is no news here.
    if not text.startswith("This plugin does not support"):
        sys.stderr.write(f"{text}\n")


def _write(window: MainWindow, folder: Path) -> list[Path]:
    names = "window.png", "rms-map.png", "rms-map.csv", "traces.csv"
    files = window_picture, map_picture, levels, traces = [folder / name for name in names]
    design, view = window.document.design, window.document.view
    skin: Any = window.panel("skin")
    export_levels(levels, design, view)
    export_traces(traces, design, view)
    save_picture(window_picture, window.grab())
    save_picture(map_picture, skin.picture(800, 1200))
    return files
