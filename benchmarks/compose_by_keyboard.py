"""The three scenes by keyboard alone."""

from pathlib import Path

from compose_checks import PATH, SWEEP_HZ, TRAIN_PLACE, check_recording, check_sweep, check_train
from composer import Composer
from PySide6.QtWidgets import QComboBox, QFileDialog, QMenu, QMessageBox, QWidget


def train(you: Composer, _: Path) -> None:
    """Fig. 2H's wavelet train: type the place, the kind, the sweep."""
    reset_range(you)
    you.go_to_panel("hand")
    you.type(str(TRAIN_PLACE))
    you.key("Enter")
    you.go_to_panel("inspector")
    you.tab_to("kind_field")
    you.type("W")
    you.settle()
    you.tab_to("Sweep…")
    you.key("Space")
    you.page()
    for name, text in (("from_sweep", "50"), ("to_sweep", "400"), ("count_sweep", "5")):
        you.tab_to(name)
        you.type(text)
    you.tab_to("spacing_sweep")
    you.type("Lo")
    you.tab_to("order_sweep")
    you.type("R")
    you.key("Enter")
    you.wait(lambda: not you.pages, "Enter agrees to the sweep")
    you.settle()
    find(you, "balance wavelets")
    you.wait(lambda: you.document.design.clips[0].waveform.gains_db, "gains are written")
    check_train(you)


def recording(you: Composer, folder: Path) -> None:
    """A recording imported, and an envelope set up over it, point by point."""
    reset_range(you)
    path = folder / "beat.wav"
    you.answer(lambda: you.key("Ctrl+I"), QFileDialog, lambda _: name_file(you, path))
    page = you.page()
    you.wait(lambda: page.ready, "the recording is read")
    you.tab_to("Import")
    you.key("Space")
    you.wait(lambda: you.document.design.clips, "the recording is a clip")
    you.settle()
    you.go_to_panel("inspector")
    you.tab_to("add_effect")
    you.answer(lambda: you.key("Space"), QMenu, lambda menu: _choose(you, menu, "Envelope"))
    you.settle()
    you.tab_to("effect_points_field")
    # From two points at level 1: down to 0 at first; up after 50 ms; on until 400 ms; 0 at the end.
    you.key("Shift+Down", 2)
    you.key("Ins")
    you.key("Shift+Left", 20)
    you.key("Shift+Up")
    you.key("Ins")
    you.key("Shift+Right", 12)
    you.key("Right", 5)
    you.key("PgDown")
    you.key("Shift+Down", 2)
    you.settle()
    you.picture("envelope by keyboard")
    check_recording(you, 1e-9, 1e-9)


def sweep(you: Composer, _: Path) -> None:
    """A sweep along the digits: places typed in the page."""
    reset_range(you)
    find(you, "motion")
    page = you.page()
    kind = page.findChildren(QComboBox)[0]
    you.tab_to(kind.objectName())
    you.type("Sw")
    you.settle()
    you.tab_to("path_field")
    you.key("Ctrl+A")
    you.type(", ".join(map(str, PATH)))
    you.tab_to("part_frequency_hz_field")
    you.type(f"{SWEEP_HZ:g}")
    you.tab_to("add_motion")
    you.key("Space")
    you.settle()
    check_sweep(you)


def reset_range(you: Composer) -> None:
    """Ctrl+N; what is there need not be kept."""

    def discard(box: QWidget) -> None:
        button = box.button(QMessageBox.StandardButton.Discard)
        for _ in range(4):
            if button.hasFocus():
                break
            you.key("Tab")
        you.key("Space")

    if you.document.modified:
        you.answer(lambda: you.key("Ctrl+N"), QMessageBox, discard)
    else:
        you.key("Ctrl+N")
    you.settle()
    you.expect(you.document.design.inputs == (), "Ctrl+N empties the hand")


def find(you: Composer, text: str) -> None:
    """Search an action by a few letters, and do it."""
    you.key("Ctrl+K")
    you.page()
    you.type(text)
    you.key("Enter")
    you.settle()


def name_file(you: Composer, path: Path) -> None:
    you.type(str(path))
    you.key("Enter")


def _choose(you: Composer, menu: QMenu, text: str) -> None:
    for _ in range(len(menu.actions()) + 1):
        line = menu.activeAction()
        if line is not None and line.text().replace("&", "") == text:
            break
        you.key("Down")
    you.key("Enter")


SCENES = (train, recording, sweep)
