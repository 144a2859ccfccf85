"""A recording, and the page opened on it."""

import numpy as np
import pytest
import soundfile
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

NO_KEYS = Qt.KeyboardModifier.NoModifier


@pytest.fixture
def sound(tmp_path):
    """Half a second of 150 Hz and of its half, at 48 kHz."""
    tone = 0.8 * np.sin(2.0 * np.pi * 150.0 * np.arange(24_000) / 48_000) * np.hanning(24_000)
    soundfile.write(tmp_path / "tap.wav", np.stack([tone, 0.5 * tone], axis=1), 48_000)
    return tmp_path / "tap.wav"


@pytest.fixture
def page_on(window, qtbot):
    """Open the page on a file, and wait until it shows what it can."""
    opened = []

    def open_on(path, place=None):
        window.imports.open_page(path, place)
        page = window.imports.pages[-1]
        opened.append(page)
        qtbot.waitUntil(lambda: not page.busy, timeout=60_000)
        QApplication.processEvents()
        return page

    return open_on
