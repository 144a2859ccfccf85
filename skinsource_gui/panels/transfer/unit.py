"""In which unit a transfer function is: output over what is driven."""

from collections.abc import Mapping
from typing import Any

#: What has to be known for it.
OF_UNIT = frozenset({"actuation", "limb_data", "scaling"})


def transfer_unit(results: Mapping[str, Any]) -> str:
    """Of a magnitude of 1; where drives have no known unit, for a sample of 1."""
    actuation = results["actuation"]
    if actuation is not None and actuation.equaliser is None:
        return "1 (m/s²)/V"
    answers_probe = actuation is not None or not results["limb_data"].per_unit_drive
    known = results["scaling"] == "probe" and answers_probe
    return "1 (m/s²)/(m/s²)" if known else "1 m/s² per sample of 1"
