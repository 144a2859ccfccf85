"""Many stimuli at once: designs × frequencies × places × …, measured on all cores.

A sweep that was stopped or killed continues in the same folder.
"""

from skinsource.studies.sweeps.measuring import Measurer
from skinsource.studies.sweeps.plan import Order, Plan, Trial, trials, varied
from skinsource.studies.sweeps.running import Sweep, read_sweep, run, sweep
from skinsource.studies.sweeps.table import StimulusFiles, SweepTable

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
