"""Responses of actuators from measurements: sweeps with an accelerometer, and tables."""

from skinsource.measuring.response_file import open_response
from skinsource.measuring.sweep_response import response_from_sweep

__all__ = ["open_response", "response_from_sweep"]
