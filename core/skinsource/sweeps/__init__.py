"""Many stimuli at once: designs × frequencies × places × …, measured on all cores.

Where a sweep ends before its end, by a kill too, it goes on in the same folder.
"""

from skinsource.sweeps.measuring import Measurer
from skinsource.sweeps.ordering import Order, Trial, trials
from skinsource.sweeps.plan import Plan
from skinsource.sweeps.running import Sweep, run, sweep
from skinsource.sweeps.stimulus_files import StimulusFiles
from skinsource.sweeps.sweep_file import read_sweep
from skinsource.sweeps.table import SweepTable
from skinsource.sweeps.variables import varied

__all__ = [
    "Measurer",
    "Order",
    "Plan",
    "StimulusFiles",
    "Sweep",
    "SweepTable",
    "Trial",
    "read_sweep",
    "run",
    "sweep",
    "trials",
    "varied",
]
