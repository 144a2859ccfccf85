"""Both tutorials, done as they are written: checks what that of the window says, takes pictures.

python benchmarks/tutorial.py     (writes docs/pictures; look at them)
"""

import argparse
import contextlib
import io
import re
import sys
import tempfile
from pathlib import Path

from pictures import save_small
from PIL import Image
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QLabel, QWidget
from studio import BARE, LEFT, settle, studio

from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.pages.files.export_page import ExportPage
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import start_design

PAGE, SCRIPT = Path("docs/tutorial-window.md"), Path("docs/tutorial-python.md")
LIMBS = tuple(f"synthetic-{number}" for number in range(1, 5))
#: Size of the pictures of scripts.
WIDTH_PX, COLOURS = 900, 96
#: Conditions are judged a moment after an edit.
JUDGED_MS = 1500


class Reader:
    """Does what the page says, and looks whether it sees what the page says."""

    def __init__(self, window: MainWindow, pictures: Path) -> None:
        self.window, self._pictures = window, pictures
        self._page = PAGE.read_text(encoding="utf-8")
        self.panel = window.panel

    def click(self, widget: QWidget, at: QPoint) -> None:
        """Click a point of a widget."""
        QTest.mouseClick(widget, LEFT, BARE, at)
        settle(self.window)

    def enter(self, name: str, text: str) -> None:
        """Click a number, type another one, press Enter."""
        field = self.panel("inspector").findChild(NumberField, f"{name}_field")
        self.click(field, field.rect().center())
        self.key(Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
        QTest.keyClicks(QApplication.focusWidget(), text)
        self.key(Qt.Key.Key_Return)

    def key(self, key: Qt.Key, held: Qt.KeyboardModifier = BARE) -> None:
        """Press a key, wherever the keyboard is."""
        QTest.keyClick(QApplication.focusWidget(), key, held)
        settle(self.window)

    def sees(self, text: str) -> None:
        """Look for words that are on the page."""
        self.finds(text)
        if text not in self._page:
            raise SystemExit(f"{PAGE} does not say {text}")

    def finds(self, text: str) -> None:
        """Look for words in the window."""
        shown = self.window.findChildren(QLabel) + self.window.findChildren(QAbstractButton)
        texts = [widget.text() for widget in shown if widget.isVisible()]
        if not any(text in each for each in texts):
            raise SystemExit(f"the window does not show {text}, but: {texts}")

    def photograph(self, name: str, widget: QWidget | None = None) -> None:
        """Keep a picture of the window, or of a page."""
        QTest.qWait(JUDGED_MS)
        settle(self.window)
        save_small((widget or self.window).grab(), self._pictures / f"window-{name}.png")


def follow(you: Reader) -> None:
    """Do the steps of the page."""
    skin, hand = you.panel("skin").map, you.panel("hand").diagram
    you.sees("−5.5 dB")
    you.photograph("start")
    you.enter("frequency_hz", "400")
    you.sees("−8.2 dB")
    you.photograph("400-hz")
    control = Qt.KeyboardModifier.ControlModifier
    you.key(Qt.Key.Key_Z, control)
    you.sees("−5.5 dB")
    for moves in (True, False):
        you.key(Qt.Key.Key_Space)
        if you.window.playback.player.playing != moves:
            raise SystemExit("Space does not start and stop the wave")
    you.click(hand, hand.site_centre(8))
    you.enter("onset_s", "150")
    you.click(skin, skin.stage.place_of(35).toPoint())
    you.sees("Output 35 · −22.6 dB re 1 m/s²")
    you.photograph("two-inputs")
    you.key(Qt.Key.Key_1, control | Qt.KeyboardModifier.ShiftModifier)
    you.enter("amplitude", "3")
    you.window.do("compare_side_by_side")
    settle(you.window)
    you.sees("1: −6.5 dB")
    you.sees("Working: 3.1 dB")
    you.photograph("compare")
    you.key(Qt.Key.Key_X)
    you.finds("Strongest: Output 28")
    you.key(Qt.Key.Key_X)
    you.finds("Strongest: Output 19")
    you.window.do("arrange_design")
    you.key(Qt.Key.Key_E, control)
    (page,) = (each for each in QApplication.topLevelWidgets() if isinstance(each, ExportPage))
    you.photograph("export", page)
    page.close()


def draw(pictures: Path) -> None:
    """Run the blocks of the tutorial in Python; what they draw becomes small."""
    code = "".join(re.findall(r"```python\n(.*?)```", SCRIPT.read_text("utf-8"), re.DOTALL))
    with tempfile.TemporaryDirectory() as folder:
        with contextlib.chdir(folder), contextlib.redirect_stdout(io.StringIO()):
            exec(compile(code, SCRIPT.name, "exec"), {})  # noqa: S102  our own page
        for path in Path(folder).glob("*.png"):
            image = Image.open(path).convert("RGB")
            image.thumbnail((WIDTH_PX, WIDTH_PX))
            image.quantize(COLOURS).save(pictures / f"python-{path.name}", optimize=True)


def main() -> int:
    """Do them once."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pictures", type=Path, default=PAGE.with_name("pictures"))
    pictures = parser.parse_args().pictures.resolve()
    with studio(start_design(LIMBS[0]), theme="light", limbs=LIMBS) as window:
        settle(window)
        QTest.qWait(JUDGED_MS)
        follow(Reader(window, pictures))
    draw(pictures)
    print("The window does what the page says.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
