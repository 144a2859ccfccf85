"""What tests do with the dialog File > Export…."""

from PySide6.QtWidgets import QPushButton


def shown(window, name):
    """Open the dialog on an export, and return the part that shows it."""
    window.do(f"export_{name}")
    return window.exports.page.part


def press(part):
    """Press the button that exports what a part shows."""
    part.window().findChild(QPushButton, "export_button").click()


def export(window, name):
    """Export something as it is offered."""
    press(shown(window, name))
