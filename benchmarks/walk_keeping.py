"""Chapters of the walkthrough: files, arrangements, themes and pages."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from driver import CONTROL, SHIFT, Driver
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QDialog, QMessageBox

from skinsource.design.design import track
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.shell.menus import Palette

KEY = Qt.Key


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
    document.mark_saved(document.path)


def export_field(you: Driver, folder: Path) -> None:
    """The whole field, written and read back; another one given up by keyboard."""
    window, document = you.window, you.window.document
    path = folder / "field.npz"
    window.do("arrange_design")
    with you.answering(path):
        window.do("export_field")
    you.picture("exporting the field")
    you.expect(you.waited(lambda: not window.runner.busy), "the export ends")
    you.picture("exported")
    you.expect(path.name in window.statusBar().currentMessage(), "the status bar tells of it")
    with np.load(path, allow_pickle=False) as archive:
        field = archive["acceleration_m_per_s2"]
        rate_hz = float(archive["sample_rate_hz"])
    you.expect(field.shape[:2] == (72, 3), f"it holds 72 outputs on 3 axes, not {field.shape}")
    you.expect(bool(np.isfinite(field).all() and field.any()), "it holds finite numbers")
    longest_s = max(clip.onset_s for clip in document.design.clips)
    you.expect(field.shape[2] > longest_s * rate_hz, "it reaches to the end of the design")
    long = track(document.design.inputs[0].location, Tone(duration_s=300.0))
    document.edit("Add a long input", document.design.adding(long))
    you.settle()
    with you.answering(folder / "long.npz"):
        window.do("export_field")
    you.focus(window.panel("spectra"))
    you.key(KEY.Key_Tab)
    you.picture("the keyboard on Cancel")
    you.key(KEY.Key_Space)
    you.expect(you.waited(lambda: not window.runner.busy), "Cancel ends it")
    you.picture("an export given up")
    you.expect(not (folder / "long.npz").exists(), "nothing is left of it")
    you.key(KEY.Key_Z, CONTROL)
    document.mark_saved(document.path)


def arrange(you: Driver, _: Path) -> None:
    """Arrangements, themes, docks, palette, pages, full screen."""
    window = you.window
    for digit, label in ((KEY.Key_2, "analysis"), (KEY.Key_3, "presenting")):
        you.key(digit, CONTROL)
        you.picture(f"arranged for {label}")
    you.key(KEY.Key_1, CONTROL)
    window.docks["spectra"].setFloating(True)
    window.docks["inspector"].close()
    you.picture("spectra afloat and no inspector")
    you.picture("floating spectra", window.docks["spectra"])
    you.key(KEY.Key_1, CONTROL)
    you.picture("arranged again")
    you.key(KEY.Key_K, CONTROL)
    palette = next(palette for palette in window.findChildren(Palette) if palette.isVisible())
    you.picture("palette", palette)
    you.type("theme")
    you.picture("palette with theme typed", palette)
    you.expect(palette.list.count() >= 3, "theme finds the themes")
    you.key(KEY.Key_Escape)
    for page in ("show_keys", "show_dataset", "show_about", "show_accuracy"):
        window.do(page)
        QApplication.processEvents()
        dialog = next(dialog for dialog in window.findChildren(QDialog) if dialog.isVisible())
        dialog.activateWindow()
        title = dialog.windowTitle()
        you.picture(f"page {title}", dialog)
        you.key(KEY.Key_Escape)
        # The dialog itself may be gone by now.
        visible = [
            dialog.windowTitle() for dialog in window.findChildren(QDialog) if dialog.isVisible()
        ]
        you.expect(title not in visible, f"Esc closes {title}")
    window.activateWindow()
    you.settle()
    you.key(KEY.Key_F11)
    you.expect(window.isFullScreen(), "F11 fills the screen")
    you.key(KEY.Key_F11)
    you.expect(not window.isFullScreen(), "and gives it back")
    window.do("use_dark_theme")
    you.picture("dark")
    window.do("use_light_theme")
