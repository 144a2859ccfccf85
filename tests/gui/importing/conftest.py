"""A recording, and the page opened on it."""

from functools import partial

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
    return partial(opened, window.imports, qtbot)


@pytest.fixture
def page_at(desk, qtbot):
    """The same without panels."""
    return partial(opened, desk.imports, qtbot)


def opened(imports, qtbot, path, place=None):
    imports.open_page(path, place)
    page = imports.pages[-1]
    qtbot.waitUntil(lambda: not page.busy, timeout=60_000)
    QApplication.processEvents()
    return page
