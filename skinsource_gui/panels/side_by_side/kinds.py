"""All that can stand side by side, by its name in `settings.OF`."""

from skinsource_gui.panels.side_by_side.kind import Kind
from skinsource_gui.panels.side_by_side.of_axes import OfAxes
from skinsource_gui.panels.side_by_side.of_limbs import OfLimbs
from skinsource_gui.panels.side_by_side.of_snapshots import OfSnapshots

KINDS: dict[str, Kind] = {"limbs": OfLimbs(), "snapshots": OfSnapshots(), "axes": OfAxes()}
