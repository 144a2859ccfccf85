"""What a prediction is not good for: conditions of the measurement that a design leaves."""

from skinsource.validity.finding import Finding, Findings
from skinsource.validity.judging import (
    SPATIAL_LIMIT_HZ,
    found_in_drives,
    found_in_outputs,
    found_in_setup,
)
from skinsource.validity.probe import are_probe_accelerations, fastest_probe, probe_velocity

__all__ = [
    "SPATIAL_LIMIT_HZ",
    "Finding",
    "Findings",
    "are_probe_accelerations",
    "fastest_probe",
    "found_in_drives",
    "found_in_outputs",
    "found_in_setup",
    "probe_velocity",
]
