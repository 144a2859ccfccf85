"""What a person sees while matching: which of both plays, and what can be done."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QHBoxLayout, QLabel, QProgressBar, QVBoxLayout, QWidget

from skinsource_gui.theme import UNIT_PX, set_tone
from skinsource_gui.widgets.keys import KEYS, Gesture
from skinsource_gui.widgets.page_button import page_button

#: What each button says, by the name of its gesture.
_BUTTONS = {
    "weaker": "Weaker  ↓",
    "stronger": "Stronger  ↑",
    "store": "Equally strong  ⏎",
    "play": "Play",
}
_SIDE_PX = 96


class RunView(QWidget):
    """Reference and test, the one that plays lit; the level is not shown, it would lead."""

    #: ``"weaker"``, ``"stronger"``, ``"store"`` or ``"play"``.
    wanted = Signal(str)

    def __init__(self) -> None:
        super().__init__()
        self._lit = ""
        self.progress, self.bar = QLabel(), QProgressBar()
        self.progress.setObjectName("matching_progress")
        self.bar.setTextVisible(False)
        self.bar.setFixedHeight(UNIT_PX)
        self.sides = {name: QLabel() for name in ("reference", "test")}
        sides = QHBoxLayout()
        sides.setSpacing(2 * UNIT_PX)
        for name, side in self.sides.items():
            side.setObjectName(f"matching_{name}")
            side.setAlignment(Qt.AlignmentFlag.AlignCenter)
            side.setMinimumHeight(_SIDE_PX)
            side.setWordWrap(True)
            sides.addWidget(side, 1)
        gestures = KEYS["matching"].gestures
        question = QLabel(
            "Make the test as strong as the reference: arrow keys make it weaker or stronger, "
            f"{gestures['store'].shown} when both feel equally strong."
        )
        question.setWordWrap(True)
        self.note = QLabel()
        self.note.setObjectName("matching_note")
        self.note.setWordWrap(True)
        self.note.setTextFormat(Qt.TextFormat.PlainText)
        self.buttons = {
            name: page_button(f"matching_{name}", label, _hint(gestures[name]))
            for name, label in _BUTTONS.items()
        }
        row = QHBoxLayout()
        for name, button in self.buttons.items():
            button.clicked.connect(lambda _=False, name=name: self.wanted.emit(name))
            row.addWidget(button, 2 if name == "store" else 1)
        rows = QVBoxLayout(self)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.setSpacing(2 * UNIT_PX)
        for part in (self.progress, self.bar, question):
            rows.addWidget(part)
        rows.addLayout(sides, 1)
        rows.addLayout(row)
        rows.addWidget(self.note)
        self._shortcuts = [
            self._shortcut(name, key) for name in _BUTTONS for key in gestures[name].keys
        ]
        self.light("")

    def show_trial(self, done: int, of: int, reference: str, test: str) -> None:
        """Say how many are done, and what both are; "" where nothing is left."""
        self.bar.setRange(0, of)
        self.bar.setValue(done)
        left = of - done
        self.progress.setText(
            f"Match {done + 1} of {of}" if left else f"All {of} matches are made. Thank you."
        )
        self.sides["reference"].setText(f"Reference\n{reference}" if left else "")
        self.sides["test"].setText(f"Test\n{test}" if left else "")

    def show_playing(self, *, playing: bool, felt: bool, left: bool) -> None:
        """Let do what can be done: what is about to be played cannot be judged yet."""
        for name in ("weaker", "stronger", "store"):
            self.buttons[name].setEnabled(felt and left)
        self.buttons["play"].setEnabled(left)
        self.buttons["play"].setText("Stop" if playing else "Play")
        if not playing:
            self.light("")

    def show_note(self, words: str, *, problem: bool = False) -> None:
        """Say something below."""
        set_tone(self.note, "error" if problem else "dim")
        self.note.setText(words)

    def light(self, which: str) -> None:
        """Light ``"reference"``, ``"test"`` or neither."""
        self._lit = which
        for name, side in self.sides.items():
            set_tone(side, "lit" if name == which else "unlit")

    @property
    def lit(self) -> str:
        """Which of both is lit, or ""."""
        return self._lit

    def _shortcut(self, name: str, key: str) -> QShortcut:
        shortcut = QShortcut(QKeySequence(key), self)
        shortcut.setContext(Qt.ShortcutContext.WindowShortcut)
        # Each press is one step: a key that is held would store match after match.
        shortcut.setAutoRepeat(name in ("weaker", "stronger"))
        shortcut.activated.connect(lambda: self._press(name))
        return shortcut

    def _press(self, name: str) -> None:
        if self.isVisible() and self.buttons[name].isEnabled():
            self.wanted.emit(name)


def _hint(gesture: Gesture) -> str:
    return f"{gesture.effect[:1].upper()}{gesture.effect[1:]} ({gesture.shown})"
