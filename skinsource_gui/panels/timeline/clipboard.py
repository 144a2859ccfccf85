"""Clips on the clipboard: for this studio and others, and as text for people."""

from PySide6.QtCore import QMimeData
from PySide6.QtWidgets import QApplication

from skinsource.design import edits
from skinsource.design.clips import Fragment

_MIME = "application/x-skinsource-clips"
# Any text that could hold clips says so in its first words.
_SIGN, _BEGINNING = "skinsource clips", 2000


def copy(fragment: Fragment) -> None:
    """Put clips on the clipboard.

    Raises
    ------
    InvalidInputError
        They hold more samples than a text may.
    """
    text = edits.fragment_text(fragment)
    data = QMimeData()
    data.setData(_MIME, text.encode())
    data.setText(text)
    QApplication.clipboard().setMimeData(data)


def pasted() -> Fragment | None:
    """The clips on the clipboard, also where they travelled as text; None: there are none.

    Raises
    ------
    FileFormatError
        They are damaged, or from a newer version.
    """
    data = QApplication.clipboard().mimeData()
    if data is None:
        return None
    if data.hasFormat(_MIME):
        return edits.fragment_from(bytes(data.data(_MIME).data()).decode(errors="replace"))
    text = data.text() if data.hasText() else ""
    return edits.fragment_from(text) if _SIGN in text[:_BEGINNING] else None
