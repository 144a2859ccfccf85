"""What the tests of the page do to it."""

import os
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QLabel,
    QPushButton,
)


def find(page, kind, name):
    return page.findChild(kind, name)


def words(page):
    return find(page, QLabel, "bench_words").text()


def press(page, name):
    QTest.mouseClick(find(page, QPushButton, name), Qt.MouseButton.LeftButton)


def measure(page, qtbot):
    press(page, "measure")
    qtbot.waitUntil(lambda: not page.run.running, timeout=20_000)


def hang(page, child, qtbot):
    """Start a benchmark that does not end; give its process and its folder."""
    note = child("hang")
    press(page, "measure")
    qtbot.waitUntil(lambda: "0 of 3" in words(page), timeout=20_000)
    number, _, folder = note.read_text().partition(" ")
    return int(number), Path(folder)


def is_alive(number):
    try:
        os.kill(number, 0)
    except ProcessLookupError:
        return False
    return True
