"""What panels are told of what is played."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from skinsource.lab.playing.devices import Output
from skinsource.lab.playing.mix import START_DB

if TYPE_CHECKING:
    from skinsource.lab.playing.devices import Device
    from skinsource.lab.playing.mix import Delay, Levels


@dataclass(frozen=True, slots=True, kw_only=True)
class Played:
    """What is played, on what, and how.

    Attributes
    ----------
    playing
        Whether anything is.
    looked
        Whether devices were looked for.
    devices
        What can be played on.
    missing
        Why nothing can be heard, and what to do; "" where it can.
    output
        What this machine plays on.
    rates_hz
        Rates that its device takes; none while that is not known.
    wired
        Pairs of a place of the design and the output that drives it.
    rig_title, calibration
        The rig of this machine, "" without one; whether what is played is calibrated, in words.
    names
        Words for what each output plays now, "" where it is silent.
    levels, delay
        How loud each output is, and how late an edit comes; None while nothing is heard.
    underruns
        How often the device ran out of samples since playing began.
    gain_db, loops
        The gain; whether a design without a loop is played again and again.
    """

    playing: bool = False
    looked: bool = False
    devices: "tuple[Device, ...]" = ()
    missing: str = ""
    output: Output = field(default_factory=Output)
    rates_hz: tuple[int, ...] = ()
    wired: tuple[tuple[int, int], ...] = ()
    rig_title: str = ""
    calibration: str = ""
    names: tuple[str, ...] = ()
    levels: "Levels | None" = None
    delay: "Delay | None" = None
    underruns: int = 0
    gain_db: float = START_DB
    loops: bool = False
