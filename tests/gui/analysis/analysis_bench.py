"""What tests of the views of Analysis share."""

from PySide6.QtGui import QGuiApplication

from skinsource.design.panel_settings import with_settings
from skinsource_gui.panels.analysis.settings import AnalysisSettings


def analysis(window, name, panel="analysis"):
    """Choose a view of Analysis, bring it into sight, and return it."""
    settings = AnalysisSettings(shown=name)
    window.document.look(with_settings(window.document.view, panel, settings))
    window.docks[panel].bring_forward()
    return window.panel(panel).view


def look_at(window, qtbot, name):
    """Bring a panel, or a view of Analysis such as ``"analysis/wave"``, into sight; return it."""
    name, _, view = name.partition("/")
    if view:
        analysis(window, view)
    window.docks[name].bring_forward()
    qtbot.waitUntil(window.panel(name).isVisible)
    return window.panel(name)


def copied(window):
    """Press Copy, and return what is on the clipboard."""
    window.panel("analysis").copy.click()
    return QGuiApplication.clipboard().text()
