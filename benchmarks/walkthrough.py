"""A whole session by mouse and keyboard, with a picture after each step.

Open the pictures and judge them.  What can be said in a sentence is checked on the way; the
sentences that do not hold are printed, and counted in the exit status.

    python benchmarks/walkthrough.py --size 1366x768 --theme light
"""

import argparse
import os
import sys
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")

from driver import CONTROL, SHIFT, Driver
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication, QDialog, QMessageBox

from skinsource.catalogue import available_limbs, default_limb
from skinsource.design import start_design
from skinsource_gui.app import make_application
from skinsource_gui.palette import Palette
from skinsource_gui.preferences import Preferences
from skinsource_gui.window import MainWindow

KEY = Qt.Key


def place_inputs(you: Driver, _: Path) -> None:
    """Click, drag, keyboard, delete, undo, redo."""
    document, hand = you.window.document, you.window.hand.diagram
    you.picture("start")
    you.click(hand, hand.site_centre(3))
    you.click(hand, hand.site_centre(18))
    you.picture("two more by click")
    you.expect(
        [one.location for one in document.design.inputs] == [7, 3, 18], "clicks place inputs"
    )
    you.drag(hand, hand.site_centre(18), hand.site_centre(16), "while dragging")
    you.expect(document.design.inputs[-1].location == 16, "a drag moves the input")
    you.key(KEY.Key_2)
    you.key(KEY.Key_0)
    you.key(KEY.Key_Return)
    you.picture("placed at 20 by keyboard")
    you.expect(document.design.inputs[-1].location == 20, "typing 20 and Enter places one there")
    you.key(KEY.Key_Up, SHIFT)
    you.key(KEY.Key_Delete)
    you.expect(len(document.design.inputs) == 3, "Delete removes one input, not two")
    selected = document.view.selected_input
    you.key(KEY.Key_Z, CONTROL)
    you.expect(len(document.design.inputs) == 4, "Ctrl+Z brings it back")
    you.expect(document.view.selected_input == 3, f"undo selects what came back, not {selected}")
    you.key(KEY.Key_Z, CONTROL, times=10)
    you.expect(document.design == start_design(document.design.limb), "undo leads to the start")
    you.expect(not document.modified, "at the start nothing is unsaved")
    you.key(KEY.Key_Y, CONTROL, times=20)
    you.expect(len(document.design.inputs) == 3, "redo leads to the end")
    you.key(KEY.Key_Z, CONTROL)
    you.picture("redone")


def edit_list(you: Driver, _: Path) -> None:
    """Select, mute, solo, duplicate in the list."""
    document, rows = you.window.document, you.window.inputs._list.rows
    you.click(rows.rows[0], QPoint(60, 12))
    you.expect(document.view.selected_input == 0, "a click on a row selects")
    you.key(KEY.Key_Down)
    you.key(KEY.Key_M)
    you.picture("second row muted by key")
    you.expect(document.design.inputs[1].muted, "M mutes")
    you.key(KEY.Key_M)
    you.click(rows.rows[2].solo)
    you.picture("third row solo")
    you.expect(document.design.inputs[2].solo, "the button S solos")
    you.click(rows.rows[2].solo)
    count = len(document.design.inputs)
    you.click(rows.rows[2], QPoint(60, 12))
    you.key(KEY.Key_D, CONTROL)
    you.expect(len(document.design.inputs) == count + 1, "Ctrl+D duplicates once")
    you.key(KEY.Key_Delete)
    you.expect(len(document.design.inputs) == count, "Delete in the list removes one")
    you.focus(you.window.skin.map)
    you.key(KEY.Key_D, CONTROL)
    you.expect(len(document.design.inputs) == count + 1, "Ctrl+D works anywhere")
    you.key(KEY.Key_Z, CONTROL)
    you.expect(len(document.design.inputs) == count, "and is undone")


def edit_numbers(you: Driver, _: Path) -> None:
    """Kinds of waveform; numbers by typing, wheel, drag and keys; what is not allowed."""
    window, document = you.window, you.window.document
    document.look(replace(document.view, selected_input=0))
    for kind in ("Tap", "Impulse", "Noise", "Tone"):
        field = you.widget("kind_field", window.inspector)
        you.focus(field)
        you.type(kind)
        you.picture(f"waveform {kind}")
        you.expect(document.design.inputs[0].waveform.title == kind, f"typing chooses {kind}")
    field = you.widget("frequency_hz_field", window.inspector)
    you.double_click(field)
    you.picture("typing a frequency")
    you.type("0,12 kHz")
    you.key(KEY.Key_Return)
    you.expect(document.design.inputs[0].waveform.frequency_hz == 120.0, "0,12 kHz is 120 Hz")
    you.type("99999")
    you.key(KEY.Key_Return)
    you.picture("a frequency out of range")
    you.expect(field.problem != "", "99999 Hz is refused with a reason")
    you.key(KEY.Key_Escape)
    you.expect(document.design.inputs[0].waveform.frequency_hz == 120.0, "Esc restores")
    you.type("12x")
    you.key(KEY.Key_Return)
    you.picture("nonsense")
    before = document.undo_stack.index()
    you.key(KEY.Key_Z, CONTROL)
    you.expect(
        document.undo_stack.index() == before, "Ctrl+Z while typing does not undo the design"
    )
    you.key(KEY.Key_Escape)
    you.key(KEY.Key_Z, CONTROL)
    you.expect(document.undo_stack.index() == before - 1, "Ctrl+Z at rest undoes the design")
    you.key(KEY.Key_Z, CONTROL | SHIFT)
    you.wheel(field, 3)
    you.expect(document.design.inputs[0].waveform.frequency_hz > 120.0, "the wheel turns it up")
    middle = field.rect().center()
    steps = document.undo_stack.count()
    you.drag(field, middle, middle + QPoint(80, 0))
    you.expect(document.undo_stack.count() == steps + 1, "a drag is one undo step")
    you.picture("a frequency dragged")
    onset = you.widget("onset_s_field", window.inspector)
    you.focus(onset)
    you.type("0.1 s")
    you.key(KEY.Key_Tab)
    you.expect(document.design.inputs[0].onset_s == 0.1, "Tab commits 0.1 s")
    you.picture("onset of 100 ms")


def select_outputs(you: Driver, _: Path) -> None:
    """Click, shift, rubber band, keyboard, volar ones."""
    document, skin = you.window.document, you.window.skin.map
    you.click(skin, skin.place_of(35).toPoint())
    you.click(skin, skin.place_of(61).toPoint(), SHIFT)
    you.expect(document.view.outputs == (35, 61), "click selects, shift-click adds a volar one")
    you.hover(skin, skin.place_of(61).toPoint())
    you.picture("35 and 61 by click")
    corner = skin.place_of(29).toPoint()
    you.drag(skin, corner + QPoint(-30, -30), corner + QPoint(40, 60))
    you.picture("by rubber band")
    you.key(KEY.Key_Down, times=2)
    you.key(KEY.Key_Space, SHIFT)
    you.picture("one more by keyboard")
    you.key(KEY.Key_A, CONTROL)
    you.expect(len(document.view.outputs) == 66, "Ctrl+A on the map selects the dorsal ones")
    you.picture("all dorsal")
    you.key(KEY.Key_A, CONTROL | SHIFT)
    you.expect(document.view.outputs == (), "Ctrl+Shift+A selects none")
    you.picture("none")
    document.look(replace(document.view, outputs=(29, 30, 33, 52)))


def read_plots(you: Driver, _: Path) -> None:
    """Zoom, crosshair, stacked, logarithmic, delay."""
    window, document = you.window, you.window.document
    traces = you.widget("traces-plot", window.traces)
    spectra = you.widget("spectra-plot", window.spectra)
    middle = traces.rect().center()
    you.hover(traces.viewport(), middle)
    you.picture("crosshair in traces")
    you.drag(traces.viewport(), middle - QPoint(150, 0), middle + QPoint(20, 0))
    shown = document.view.time_range_s
    you.expect(shown is not None, "a drag zooms the traces")
    you.picture("traces zoomed")
    you.click(you.widget("remove-delay", window.traces))
    moved = document.view.time_range_s
    you.expect(moved is not None and moved != shown, "without delay the same piece is shown")
    you.key(KEY.Key_T, CONTROL)
    you.expect(document.view.time_range_s == shown, "the menu does the same as the switch")
    you.focus(traces)
    you.key(KEY.Key_Right, SHIFT)
    you.key(KEY.Key_0)
    you.picture("traces keyboard crosshair")
    you.expect(document.view.time_range_s is None, "0 shows everything")
    you.key(KEY.Key_Escape)
    you.click(you.widget("stacked", window.traces))
    you.click(you.widget("stacked", window.spectra))
    you.click(you.widget("log-frequency", window.spectra))
    you.picture("stacked and logarithmic")
    you.click(you.widget("log-magnitude", window.spectra))
    you.wheel(spectra.viewport(), 5, modifiers=CONTROL)
    you.picture("spectra linear and zoomed")
    you.expect(document.view.frequency_range_hz is not None, "Ctrl and wheel zooms")
    you.double_click(spectra.viewport())
    for panel in (window.traces, window.spectra):
        you.click(you.widget("overlaid", panel))
    you.focus(you.widget("overlaid", window.spectra))
    you.picture("focus on a checked button")


def colour_the_map(you: Driver, _: Path) -> None:
    """Range of the colours; sensors; styles."""
    window, document = you.window, you.window.document
    high = you.widget("range_high", window.skin)
    you.drag(high, high.rect().center(), high.rect().center() + QPoint(0, 60))
    you.expect(document.view.map_range_db is not None, "a handle sets the range")
    you.picture("range dragged")
    field = you.widget("range_low_field", window.skin)
    you.double_click(field)
    you.picture("typing a level")
    you.key(KEY.Key_A, CONTROL)
    you.type("-45,5")
    you.key(KEY.Key_Return)
    low = document.view.map_range_db[0]
    you.expect(low == -45.5, f"-45,5 is understood, not {low}")
    steps = document.undo_stack.index()
    you.key(KEY.Key_Z, CONTROL)
    you.expect(document.undo_stack.index() == steps - 1, "Ctrl+Z in a level at rest undoes")
    you.key(KEY.Key_Y, CONTROL)
    you.picture("a level typed")
    you.click(you.widget("range_auto", window.skin))
    you.expect(document.view.map_range_db is None, "Auto gives the range back")
    you.click(you.widget("map_sensors_shown", window.skin))
    you.picture("no sensors")
    you.click(you.widget("map_sensors_only", window.skin))
    you.picture("sensors only")
    you.click(you.widget("map_interpolated", window.skin))
    you.click(you.widget("map_sensors_shown", window.skin))
    you.click(you.widget("map_fit_hand", window.skin))
    you.picture("the hand alone")
    you.click(you.widget("map_fit_all", window.skin))


def change_setup(you: Driver, _: Path) -> None:
    """Axes, method, scaling, limb, by keyboard."""
    window, document = you.window, you.window.document
    for name, letters in (("method", "Sum"), ("scaling", "Equal")):
        you.focus(you.widget(name, window.setup_bar))
        you.type(letters)
        you.picture(f"{name} {letters}")
    you.focus(you.widget("axes", window.setup_bar))
    you.key(KEY.Key_Home)
    you.picture("a single axis")
    you.expect(document.view.axes == "x", "Home chooses the first axis")
    unit = you.widget("amplitude_field", window.inspector).spec.unit
    you.expect(unit == "×", "the unit of the amplitude follows the scaling")
    you.focus(you.widget("limb", window.setup_bar))
    you.key(KEY.Key_End)
    you.expect(document.design.limb == "synthetic-4", "End chooses the last limb")
    you.picture("another limb")
    you.key(KEY.Key_Z, CONTROL, times=2)
    missing = replace(document.design, limb="measured-4")
    if missing.limb not in available_limbs():
        document.edit("Change limb", missing)
        you.picture("a limb that is not installed")
        you.focus(you.widget("limb", window.setup_bar))
        you.key(KEY.Key_End)
        you.expect(window.notice.text == "", "another limb ends the trouble")
        you.picture("and another that is")
        document.undo_stack.setIndex(document.undo_stack.index() - 2)


def keep_files(you: Driver, folder: Path) -> None:
    """Save, reopen, recent files, bad files, read-only folders, drops."""
    window, document = you.window, you.window.document
    you.expect(window.isWindowModified(), "edits mark the title")
    with you.answering(folder / "my.first design") as asked:
        you.key(KEY.Key_S, CONTROL)
    path = folder / "my.first design.skinsource"
    you.expect(len(asked) == 1 and path.exists(), "Save asks for a name and adds the ending")
    you.expect(not window.isWindowModified(), "saving clears the mark")
    saved = (document.design, document.view)
    with you.answering(folder / "second.skinsource"):
        you.key(KEY.Key_S, CONTROL | SHIFT)
    you.key(KEY.Key_N, CONTROL)
    you.picture("a new design")
    with you.answering(path) as asked:
        you.key(KEY.Key_O, CONTROL)
    you.expect(str(folder) in map(str, asked[0]), "the dialog opens where the last file lies")
    you.expect((document.design, document.view) == saved, "design and view come back exactly")
    you.picture("reopened")
    bad = folder / "bad.skinsource"
    bad.write_bytes(b"not a design")
    window.files.open(bad)
    you.picture("a bad file")
    you.expect(document.path == path, "a bad file changes nothing")
    with you.answering(bad / "inside a file.skinsource"):
        you.key(KEY.Key_S, CONTROL | SHIFT)
    you.picture("a folder that cannot be written")
    you.expect(window.notice.text != "", "a failed save is told")
    document.edit("Remove all inputs", replace(document.design, inputs=()))
    with you.answering(answer=QMessageBox.StandardButton.Cancel) as asked:
        you.key(KEY.Key_N, CONTROL)
    you.expect(len(asked) == 1 and document.path == path, "unsaved edits are asked about")
    you.picture("all inputs removed")
    you.key(KEY.Key_Z, CONTROL)
    document.undo_stack.setClean()


def arrange(you: Driver, _: Path) -> None:
    """Arrangements, themes, docks, palette, pages, full screen."""
    window = you.window
    for digit, words in ((KEY.Key_2, "analysis"), (KEY.Key_3, "presenting")):
        you.key(digit, CONTROL)
        you.picture(f"arranged for {words}")
    you.key(KEY.Key_1, CONTROL)
    window.docks["spectra"].setFloating(True)
    window.docks["inspector"].close()
    you.picture("spectra afloat and no inspector")
    you.picture("floating spectra", window.docks["spectra"])
    you.key(KEY.Key_1, CONTROL)
    you.picture("arranged again")
    you.key(KEY.Key_K, CONTROL)
    palette = next(one for one in window.findChildren(Palette) if one.isVisible())
    you.picture("palette", palette)
    you.type("theme")
    you.picture("palette with theme typed", palette)
    you.expect(palette.list.count() == 3, "theme finds the three themes")
    you.key(KEY.Key_Escape)
    pages: tuple[Callable[[], None], ...] = (
        window.commands.show_keys,
        window.commands.show_dataset_help,
        window.commands.show_about,
    )
    for page in pages:
        page()
        QApplication.processEvents()
        dialog = next(one for one in window.findChildren(QDialog) if one.isVisible())
        you.picture(f"page {dialog.windowTitle()}", dialog)
        dialog.close()
    you.key(KEY.Key_F11)
    you.expect(window.isFullScreen(), "F11 fills the screen")
    you.key(KEY.Key_F11)
    you.expect(not window.isFullScreen(), "and gives it back")
    window.commands.use_dark_theme()
    you.picture("dark")
    window.commands.use_light_theme()


CHAPTERS = (
    place_inputs,
    edit_list,
    edit_numbers,
    select_outputs,
    read_plots,
    colour_the_map,
    change_setup,
    keep_files,
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
        window.commands.arrange_design()
        you = Driver(window, options.folder)
        you.settle()
        try:
            for chapter in CHAPTERS:
                print(chapter.__doc__)
                chapter(you, Path(scratch))
        finally:
            window.document.undo_stack.setClean()
            window.close()
    return len(you.disappointments)


if __name__ == "__main__":
    sys.exit(main())
