"""The base of the pages that a menu opens."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QRectF, QSize, Qt, QTimer

from skinsource.base.errors import SkinSourceError, sentence
from skinsource.base.files import path_text
from skinsource_gui.qt.buttons import page_button, page_label
from skinsource_gui.qt.layouts import Policy
from skinsource_gui.qt.questions import ask_save
from skinsource_gui.qt.theme import set_tone
from skinsource_gui.state.job_runner import PageJobs
from skinsource_gui.state.preferences import Preferences

_POLL_MS = 10


class PictureView(QtWidgets.QWidget):
    """Shows a picture as large as there is room.

    Attributes
    ----------
    image
        The picture.
    """

    def __init__(self) -> None:
        super().__init__()
        self.image = QtGui.QImage()
        self.setSizePolicy(Policy.Expanding, Policy.Expanding)

    def sizeHint(self) -> QSize:
        return QSize(360, 480)

    def show_image(self, image: QtGui.QImage) -> None:
        """Show another picture."""
        self.image = image
        self.update()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        if self.image.isNull():
            return
        size = self.image.size().scaled(self.size(), Qt.AspectRatioMode.KeepAspectRatio)
        area = QRectF((self.width() - size.width()) / 2, 0, size.width(), size.height())
        painter = QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.RenderHint.SmoothPixmapTransform)
        painter.drawImage(area, self.image)


class ToolPage(QtWidgets.QDialog):
    """A window of its own with a message and buttons, which is deleted when it is closed.

    Parameters
    ----------
    parent
        The window in front of which it opens.
    name, title
        Object name, and title of the window.
    size_px
        First size; by default as large as its content.

    Attributes
    ----------
    message
        Label that a page lays out where it says what happens; hidden until it has a parent.
    """

    def __init__(
        self,
        parent: QtWidgets.QWidget | None,
        name: str,
        title: str,
        size_px: tuple[int, int] | None = None,
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setObjectName(name)
        self.setWindowTitle(title)
        self.message = page_label("page_message")
        if size_px is not None:
            self.resize(*size_px)

    def say(self, text: str) -> None:
        """Show a message."""
        set_tone(self.message, "")
        self.message.setText(text)

    def say_reading(self, text: str) -> None:
        """Show what is read under the pointer of a figure, if anything is."""
        if text:
            self.say(text)

    def complain(self, reason: str) -> None:
        """Show why something did not work."""
        set_tone(self.message, "error")
        self.message.setText(sentence(reason))

    def follow_jobs(
        self,
        jobs: PageJobs,
        done: Callable[..., object],
        *,
        progressed: Callable[..., object] | None = None,
        cancelled: str = "Cancelled. Nothing was changed.",
    ) -> None:
        """Say what becomes of jobs; how far they are, too, unless ``progressed`` does."""
        jobs.progressed.connect(progressed or (lambda _, step: self.say(f"{step.text}…")))
        jobs.done.connect(done)
        jobs.failed.connect(self.complain)
        jobs.cancelled.connect(lambda: self.say(cancelled))

    def once_released(self, do: Callable[[], object]) -> None:
        """Do something once the mouse is up: for a window that is hidden before, it stays down."""
        if QtWidgets.QApplication.mouseButtons():
            QTimer.singleShot(_POLL_MS, self, partial(self.once_released, do))
        else:
            do()

    def add_button(
        self, name: str, text: str, hint: str, do: Callable[[], object]
    ) -> QtWidgets.QPushButton:
        """Return a button that does something when it is pressed; the page lays it out."""
        button = page_button(name, text, hint)
        button.clicked.connect(lambda: do())
        return button

    def add_arm(self, name: str, follow: Callable[[bool], object]) -> QtWidgets.QPushButton:
        """Return the button before which nothing is sent to actuators, as in the panel Output."""
        arm = page_button(name, "Arm actuators", "Allow to play on the actuators")
        arm.setCheckable(True)
        arm.toggled.connect(lambda on: arm.setText("Armed" if on else "Arm actuators"))
        arm.toggled.connect(follow)
        return arm

    def ask_save(self, title: str, kinds: str, start: Path) -> Path | None:
        """Ask for a file to write; None where the user has chosen none."""
        return ask_save(self, title, start, kinds)

    def save_as(self, path: Path, write: Callable[[], object], preferences: Preferences) -> bool:
        """Write a file and remember its folder, or say why not; return whether it is written."""
        try:
            write()
        except SkinSourceError as error:
            self.complain(str(error))
            return False
        preferences.folder = path.parent
        self.say(f"Saved {path_text(Path(path.name))}.")
        return True
