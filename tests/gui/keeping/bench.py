"""Unsaved work, and the copies that are kept of it."""

from contextlib import suppress

from skinsource.design.design_file import open_design


def edit(window, amplitude):
    window.document.edit("a", window.document.design.with_input(0, amplitude=amplitude))


def copies(folder):
    while True:
        # One may be deleted while they are looked at: look again.
        with suppress(FileNotFoundError):
            copies = folder.glob("unsaved/*/*.skinsource")
            return sorted(copies, key=lambda path: path.stat().st_mtime_ns)


def saved_amplitudes(folder):
    return [open_design(path).design.inputs[0].amplitude for path in copies(folder)]
