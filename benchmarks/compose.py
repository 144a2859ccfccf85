"""Compose stimuli from the empty studio, by keyboard alone.

The wavelet train of Fig. 2H, an envelope over an imported recording, a sweep along the digits, and
four channels of a WAV file through an equalised voice coil.
Nothing is done that a user cannot do.  Each scene prints how long it took; sentences about the
design and its levels that do not hold are printed, and counted in the exit status.

    python benchmarks/compose.py
"""

import argparse
import os
import sys
import tempfile
from pathlib import Path
from time import perf_counter

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")

import compose_by_keyboard
import compose_export
from compose_checks import write_recording
from composer import Composer
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource.limbs.catalog import available_limbs
from skinsource_gui.app.app import make_application, manage_garbage_collection
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import Preferences, start_design

SCENES = (*compose_by_keyboard.SCENES, compose_export.by_keyboard)


def main() -> int:
    """Compose; return how many sentences did not hold."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", help="name of one scene")
    parser.add_argument("--size", default="1366x718")
    parser.add_argument("--folder", type=Path, default=Path("build/compose"))
    options = parser.parse_args()
    make_application()
    # A quick hand: what is typed next begins anew sooner.
    QApplication.setKeyboardInputInterval(100)
    QApplication.setDoubleClickInterval(100)
    # A file dialog of the desktop belongs to another program, which a script cannot look into.
    QApplication.setAttribute(Qt.ApplicationAttribute.AA_DontUseNativeDialogs)
    options.folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        scratch = Path(name)
        write_recording(scratch)
        preferences = Preferences(scratch / "studio.ini")
        preferences.folder = scratch
        window = MainWindow(
            start_design("synthetic-1"), preferences=preferences, available_limbs=available_limbs()
        )
        manage_garbage_collection(window)
        window.resize(*map(int, options.size.split("x")))
        window.show()
        window.activateWindow()
        you = Composer(window, options.folder)
        QTest.qWait(500)
        you.settle()
        try:
            for scene in SCENES:
                if options.only not in (None, scene.__name__):
                    continue
                began_s, steps = perf_counter(), you.steps
                scene(you, scratch)
                took_s = perf_counter() - began_s
                print(
                    f"{scene.__doc__} By keyboard: {you.steps - steps} steps, {took_s:.1f} s",
                    flush=True,
                )
                you.picture(f"{scene.__name__} by keyboard")
        finally:
            window.close_unasked()
    return len(you.disappointments)


if __name__ == "__main__":
    sys.exit(main())
