"""Chapters of the walkthrough: files, arrangements, themes and pages."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from driver import CONTROL, SHIFT, Driver
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QDialog, QMessageBox

from skinsource_gui.palette import Palette

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
