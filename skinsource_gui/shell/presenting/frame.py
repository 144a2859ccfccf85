"""What is done with the window as a whole, by the names that the table of actions has for it."""

from typing import TYPE_CHECKING

from skinsource_gui.shell.presenting.presenter import Presenter
from skinsource_gui.shell.window_frame import WindowFrame

if TYPE_CHECKING:
    from skinsource_gui.shell.window import MainWindow


def frame_capabilities(window: "MainWindow") -> dict[str, object]:
    """Who closes, enlarges and presents a window."""
    return {"frame": WindowFrame(window, window.document), "presenter": Presenter(window)}
