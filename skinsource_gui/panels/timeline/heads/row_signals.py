"""What heads of tracks tell."""

from PySide6.QtCore import QObject, Signal


class RowSignals(QObject):
    """What the controls of all rows tell; each signal begins with the id of an input."""

    #: The keyboard went to its number.
    entered = Signal(int)
    amplitude_edited = Signal(int, float, object)
    mute_toggled = Signal(int)
    solo_toggled = Signal(int)
    removed = Signal(int)
