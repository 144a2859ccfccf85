"""How loud it is played; kept by nobody, so that each studio begins softly."""

from PySide6.QtCore import QObject, Signal

from skinsource.lab.playing.mix import HIGHEST_DB, LOWEST_DB, START_DB

#: Digits behind the point: nobody hears, or reads, more.
DECIMALS = 2
_STEP_DB = 1.0


class GainSetting(QObject):
    """A gain, in dB: at 0 dB an amplitude of 1 is full scale.

    Attributes
    ----------
    gain_db
        The gain.
    """

    #: The new gain, dB.
    changed = Signal(float)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.gain_db = START_DB

    def put(self, gain_db: float) -> None:
        """Choose a gain; the nearest that can be, in hundredths of a dB."""
        wanted_db = round(min(max(gain_db, LOWEST_DB), HIGHEST_DB), DECIMALS)
        if wanted_db != self.gain_db:
            self.gain_db = wanted_db
            self.changed.emit(wanted_db)

    def start_anew(self) -> None:
        """Go back to where it starts."""
        self.put(START_DB)

    def turn_up(self) -> None:
        """Make it louder by 1 dB."""
        self.put(self.gain_db + _STEP_DB)

    def turn_down(self) -> None:
        """Make it softer by 1 dB."""
        self.put(self.gain_db - _STEP_DB)
