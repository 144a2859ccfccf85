"""What the library lists, and what was done from it."""

from PySide6.QtCore import Qt

KEY = Qt.Key


def names(panel):
    return [panel.model.index(k).data() for k in range(panel.model.rowCount())]


def go_to(panel, name):
    panel.rows.go_to(names(panel).index(name))


def labels(window):
    stack = window.document.undo_stack
    return [stack.text(k) for k in range(stack.count())]
