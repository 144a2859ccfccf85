"""What tests of the page of limbs share."""

from PySide6.QtWidgets import QPushButton

from skinsource.limbs.own_limbs import own_limb_names


def text_of_page(page):
    return page.message.text()


def button(page, name):
    return page.findChild(QPushButton, name)


def opened(page, path, what, qtbot):
    page.open_file(path, what)
    qtbot.waitUntil(lambda: not page.worker.busy, timeout=60_000)


def imported(page, name, qtbot):
    button(page, "import_limb").click()
    qtbot.waitUntil(lambda: text_of_page(page).startswith("Imported as"), timeout=60_000)
    assert name in own_limb_names()


def rested(window, qtbot):
    """Wait until the window shows what is computed."""
    qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)
    window.catch_up()
