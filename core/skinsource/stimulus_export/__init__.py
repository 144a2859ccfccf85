"""A stimulus leaves for files: prepared, looked at, written whole or not at all."""

from skinsource.stimulus_export.export import Exported, export_stimulus
from skinsource.stimulus_export.options import StimulusOptions
from skinsource.stimulus_export.preparing import Prepared, prepared
from skinsource.stimulus_export.safety import Limit

__all__ = ["Exported", "Limit", "Prepared", "StimulusOptions", "export_stimulus", "prepared"]
