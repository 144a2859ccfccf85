"""A whole session by mouse and keyboard, with a picture after each step.

Open the pictures and judge them.  What can be said in a sentence is checked on the way; the
sentences that do not hold are printed, and counted in the exit status.

    python benchmarks/walkthrough.py --size 1366x768 --theme light
"""

import argparse
import os
import sys
import tempfile
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")

from driver import Driver
from PySide6.QtWidgets import QMessageBox
from walk_editing import edit_list, edit_numbers, place_inputs
from walk_keeping import arrange, export_field, keep_files
from walk_keyboard import go_by_keyboard
from walk_looking import change_setup, colour_the_map, read_plots, select_outputs

from skinsource.limbs.catalog import available_limbs, default_limb
from skinsource_gui.app.app import make_application
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import Preferences, start_design

CHAPTERS = (
    place_inputs,
    edit_list,
    edit_numbers,
    select_outputs,
    read_plots,
    colour_the_map,
    change_setup,
    keep_files,
    export_field,
    go_by_keyboard,
    arrange,
)


def main() -> int:
    """Walk through; return how many sentences did not hold."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", default="1366x768")
    parser.add_argument("--theme", choices=("light", "dark"), default="light")
    parser.add_argument("--folder", type=Path, default=Path("build/walkthrough"))
    options = parser.parse_args()
    make_application()
    options.folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        preferences = Preferences(Path(scratch) / "studio.ini")
        preferences.theme_name = options.theme
        window = MainWindow(
            start_design(default_limb()),
            preferences=preferences,
            available_limbs=available_limbs(),
        )
        window.resize(*map(int, options.size.split("x")))
        window.show()
        window.do("arrange_design")
        you = Driver(window, options.folder)
        you.settle()
        you.expect(window.notice.text == "", f"the start design is shown ({window.notice.text})")
        try:
            for chapter in CHAPTERS:
                print(chapter.__doc__)
                chapter(you, Path(scratch))
        finally:
            window.document.mark_saved(window.document.path)
            # Whatever it asks, such as whether to stop an export.
            with you.answering(answer=QMessageBox.StandardButton.Yes):
                window.close()
    return len(you.disappointments)


if __name__ == "__main__":
    sys.exit(main())
