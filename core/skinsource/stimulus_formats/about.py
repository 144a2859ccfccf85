"""What a file says of itself, where it has room for a few words."""

from typing import Any

from skinsource.stimulus_formats.stimulus_format import Outgoing
from skinsource.version import __version__


def about(outgoing: Outgoing) -> dict[str, Any]:
    """Title, unit, full scale and what else a reader needs; the sidecar says more."""
    stimulus = outgoing.stimulus
    return {
        "title": outgoing.design.title,
        "channels": [one.title for one in stimulus.channels],
        "places": [one.place for one in stimulus.channels],
        "unit": stimulus.unit,
        "full_scale": outgoing.full_scale,
        "rate_hz": outgoing.rate_hz,
        "start_s": stimulus.start_s,
        "scaling": stimulus.scaling,
        "limb": stimulus.limb,
        "calibration": outgoing.calibration,
        "software": f"SkinSource studio {__version__}",
        "design_digest": outgoing.digest,
    }
