"""The presets that the library ships, as they are made; the files lie in its data folder.

``python -m skinsource.presets.shipped`` writes the files anew; the list of data files follows
with ``python tests/core/test_shipped_files.py``.
"""

from skinsource.presets.preset import Preset
from skinsource.presets.shipped.modulated import MODULATED
from skinsource.presets.shipped.moving import MOVING
from skinsource.presets.shipped.steady import STEADY
from skinsource.presets.shipped.touches import TOUCHES
from skinsource.presets.shipped.wavelets import WAVELETS

SHIPPED: tuple[Preset, ...] = (*STEADY, *MODULATED, *TOUCHES, *WAVELETS, *MOVING)

__all__ = ["SHIPPED"]
