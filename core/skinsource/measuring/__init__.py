"""Responses of actuators from measurements: sweeps with an accelerometer, and tables."""

from typing import TYPE_CHECKING

from skinsource.late import late_names

if TYPE_CHECKING:
    from skinsource.measuring.response_file import open_response
    from skinsource.measuring.sweep_response import response_from_sweep
else:
    __getattr__, __dir__ = late_names(
        __name__,
        {
            "response_file": "open_response",
            "sweep_response": "response_from_sweep",
        },
    )

__all__ = ["open_response", "response_from_sweep"]
