"""The scenes as they are made; their design files lie in the data folder.

``python -m skinsource.scenes.shipped`` writes the files anew; the list of data files follows with
``python tests/core/test_shipped_files.py``.  To add a scene, describe it in one of these modules,
and draw its figure in `skinsource.figures`.
"""

from skinsource.scenes.shipped.checks import CHECKS
from skinsource.scenes.shipped.impulse_responses import IMPULSE_RESPONSES
from skinsource.scenes.shipped.making import MadeScene
from skinsource.scenes.shipped.stimuli import STIMULI

SHIPPED: tuple[MadeScene, ...] = (*IMPULSE_RESPONSES, *STIMULI, *CHECKS)

__all__ = ["SHIPPED", "MadeScene"]
