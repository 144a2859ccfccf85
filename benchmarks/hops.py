"""How many functions of ours one step of a drag calls on the GUI thread.

One input with a tone, the arrangement that a new window has; the mouse drags the frequency in the
inspector.  Counted is the second step, from the move of the mouse until its results are painted:
the calls of functions below ``core`` and ``skinsource_gui``, comprehensions left out, and the files
that the functions stand in.  Python 3.11: later versions inline comprehensions.

    QT_QPA_PLATFORM=offscreen python benchmarks/hops.py [--list]
"""

import argparse
import os
import sys
from collections import Counter
from pathlib import Path
from types import CodeType, FrameType

from PySide6.QtCore import QEvent, QPoint
from PySide6.QtWidgets import QApplication
from studio import FINE, MOVE, PRESS, RELEASE, send_mouse, studio

from skinsource.design.design import Design, View, track
from skinsource.design.waveforms.tones import Tone
from skinsource.limbs.catalog import default_limb
from skinsource_gui.fields.number_field import PIXELS_PER_STEP, NumberField
from skinsource_gui.shell.window import MainWindow

MOST_CALLS, MOST_FILES = 1400, 110
DRAGS = 7
_ROOT = Path(__file__).resolve().parents[1]
_OURS = tuple(f"{_ROOT / folder}{os.sep}" for folder in ("core", "skinsource_gui"))
_COMPREHENSIONS = {"<listcomp>", "<setcomp>", "<dictcomp>", "<genexpr>"}


class CallCounter:
    """Counts calls of functions of ours while it is entered; in this thread only."""

    def __init__(self) -> None:
        self.calls: Counter[CodeType] = Counter()
        self.callers: Counter[tuple[str, str]] = Counter()

    def __enter__(self) -> None:
        sys.setprofile(self._note)

    def __exit__(self, *_: object) -> None:
        sys.setprofile(None)

    @property
    def files(self) -> set[str]:
        """The files that the functions stand in."""
        return {code.co_filename for code in self.calls}

    def _note(self, frame: FrameType, event: str, _: object) -> None:
        code = frame.f_code
        if event == "call" and code.co_name not in _COMPREHENSIONS and _is_ours(code):
            self.calls[code] += 1
            self.callers[_caller(frame), _label(code)] += 1


def _is_ours(code: CodeType) -> bool:
    return code.co_filename.startswith(_OURS)


def _label(code: CodeType) -> str:
    return f"{Path(code.co_filename).relative_to(_ROOT)}: {code.co_qualname}"


def _caller(frame: FrameType) -> str:
    before = frame.f_back
    while before is not None and not _is_ours(before.f_code):
        before = before.f_back
    return "Qt" if before is None else _label(before.f_code)


class Drag:
    """Drags the frequency of the selected input, a step of the number at a time."""

    def __init__(self, window: MainWindow) -> None:
        self._window = window
        field = window.panel("inspector").findChild(NumberField, "frequency_hz_field")
        if field is None:
            raise SystemExit("The inspector shows no frequency.")
        self._field, self._travel_px = field, 0
        self._send(PRESS)

    def step(self) -> None:
        """Move the mouse, until the results are painted."""
        self._travel_px += PIXELS_PER_STEP
        self._send(MOVE)
        while self._window.engine.busy:
            QApplication.processEvents()
        QApplication.processEvents()

    def release(self) -> None:
        """Let go of the mouse."""
        self._send(RELEASE)

    def _send(self, kind: QEvent.Type) -> None:
        place = self._field.rect().center() + QPoint(round(self._travel_px), 0)
        send_mouse(self._field, kind, place, FINE)


def count_second_step() -> CallCounter:
    """Return the calls of the second step of a drag: the least of a few drags.

    Where the worker is slow for once, a step is painted twice: before and with its results.
    """
    tone = track(location=4, waveform=Tone(frequency_hz=80.0, duration_s=1.0), colour=0)
    design = Design(limb=default_limb(), inputs=(tone,))
    with studio(design, View(selected_inputs=tuple(design.ids)), (1440, 900)) as window:
        window.catch_up()
        QApplication.processEvents()
        counters = [_of_a_drag(window) for _ in range(DRAGS)]
        window.catch_up()
    return min(counters, key=lambda counter: counter.calls.total())


def _of_a_drag(window: MainWindow) -> CallCounter:
    drag, counter = Drag(window), CallCounter()
    drag.step()
    with counter:
        drag.step()
    drag.release()
    QApplication.processEvents()
    return counter


def main() -> int:
    """Print the figures; 1 if there are more than promised."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--list", action="store_true", help="also each function, most called first")
    parser.add_argument("--callers", action="store_true", help="also who calls what")
    options = parser.parse_args()
    counter = count_second_step()
    if options.list:
        for code, count in counter.calls.most_common():
            print(f"{count:5d} {_label(code)}")
    if options.callers:
        for (caller, called), count in sorted(counter.callers.items()):
            print(f"{count:5d} {caller} -> {called}")
    calls, files = counter.calls.total(), len(counter.files)
    holds = calls <= MOST_CALLS and files <= MOST_FILES
    print(
        f"{calls} calls in {files} files (promised: {MOST_CALLS} in {MOST_FILES}): "
        f"{'kept' if holds else 'BROKEN'}"
    )
    return int(not holds)


if __name__ == "__main__":
    sys.exit(main())
