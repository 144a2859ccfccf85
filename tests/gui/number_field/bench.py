"""What the tests of this folder share."""

import math

from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit, QVBoxLayout, QWidget

from skinsource.specs.numbers import NumberSpec
from skinsource_gui.fields.number_field import NumberField
from tests.gui.wheel import NOTCH, turn_wheel

DURATION = NumberSpec(label="Duration", unit="s", minimum=0.001, maximum=600.0, step=0.01)


FREQUENCY = NumberSpec(
    label="Frequency", unit="Hz", minimum=1.0, maximum=649.0, step=0.02, logarithmic=True
)


PHASE = NumberSpec(label="Phase", unit="rad", minimum=-2 * math.pi, maximum=2 * math.pi, step=0.1)


SEED = NumberSpec(label="Seed", minimum=0, maximum=2**31 - 1, whole=True)


AMPLITUDE = NumberSpec(label="Amplitude", unit="m/s²", minimum=-1000, maximum=1000, step=0.05)


class Bench(QWidget):
    """A field among others, and what it told."""

    def __init__(self, spec, value):
        super().__init__()
        layout = QVBoxLayout(self)
        self.field = NumberField(spec)
        self.field.set_value(value)
        self.other = QLineEdit()
        layout.addWidget(self.field)
        layout.addWidget(self.other)
        self.edits = []
        self.field.edited.connect(self._note)

    def _note(self, value, gesture):
        self.edits.append((value, gesture))

    @property
    def values(self):
        return [value for value, _ in self.edits]

    @property
    def gestures(self):
        return {gesture for _, gesture in self.edits}

    def type(self, text):
        self.field.setFocus()
        QTest.keyClicks(self.field, text)
        QTest.keyClick(self.field, Qt.Key.Key_Return)

    def drag(self, *points, modifiers=Qt.KeyboardModifier.NoModifier):
        start = self.field.rect().center()
        QTest.mousePress(self.field, Qt.MouseButton.LeftButton, modifiers, start)
        for point in points:
            here = QPointF(start + QPoint(*point))
            event = move_event(self.field, here, modifiers)
            QApplication.sendEvent(self.field, event)
        QTest.mouseRelease(self.field, Qt.MouseButton.LeftButton, modifiers, start)

    def turn(self, notches, modifiers=Qt.KeyboardModifier.NoModifier):
        return turn_wheel(self.field, self.field.rect().center(), (0, NOTCH * notches), modifiers)


def move_event(widget, here, modifiers):
    return QMouseEvent(
        QEvent.Type.MouseMove,
        here,
        QPointF(widget.mapToGlobal(here.toPoint())),
        Qt.MouseButton.NoButton,
        Qt.MouseButton.LeftButton,
        modifiers,
    )
