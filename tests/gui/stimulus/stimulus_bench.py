"""What tests do with the page of File > Export…, Stimulus."""

from PySide6.QtWidgets import QLabel, QPushButton

#: The first one imports scipy, on a machine that may be busy.
WAIT_MS = 30_000


def label(page, name):
    return page.findChild(QLabel, f"stimulus_{name}").text()


def choose(page, qtbot, name, option):
    page.form.field(name).choose(option)
    qtbot.waitUntil(lambda: not page.busy, timeout=WAIT_MS)


def export(window, page, qtbot):
    page.window().findChild(QPushButton, "export_button").click()
    qtbot.waitUntil(lambda: not window.runner.busy, timeout=WAIT_MS)
