"""CONTRIBUTING's recipes for a waveform and for a field, followed to the letter in a copy."""

CLICKS = '''
"""A train of clicks."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource.specs import fields
from skinsource.specs.fields import CurveSpec, NumberSpec, OptionalSpec, SamplesSpec, TextSpec
from skinsource.specs.samples import Samples

LEVEL = NumberSpec(label="Level", minimum=0.0, maximum=1.0)
TIME = NumberSpec(label="Time", unit="s", minimum=0.0, maximum=1.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Clicks:
    """A click at each multiple of the gap."""

    title: ClassVar[str] = "Clicks"

    gap_s: float = fields.number(0.05, NumberSpec(label="Gap", unit="s", minimum=0.01, maximum=1.0))
    duration_s: float = fields.number(
        0.2, NumberSpec(label="Duration", unit="s", minimum=0.01, maximum=9.0)
    )
    name: str = fields.text("", TextSpec(label="Name", longest=20))
    envelope: tuple[tuple[float, float], ...] = fields.field(
        CurveSpec(label="Envelope", x=TIME, y=LEVEL), ((0.0, 1.0), (1.0, 0.5))
    )
    drawn: Samples | None = fields.field(
        OptionalSpec(label="Drawn", of=SamplesSpec(label="Drawn")), None
    )

    def __post_init__(self) -> None:
        fields.check(self)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1."""
        drive = np.zeros(round(self.duration_s * sample_rate_hz))
        drive[:: round(self.gap_s * sample_rate_hz)] = 1.0
        return drive
'''

TRY = """
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from PySide6.QtWidgets import QApplication

from skinsource.design.design import Design, Input, track
from skinsource.design.design_file import open_design, save_design
from skinsource.design.edits import change_kind
from skinsource.engine.quantities import new_graph, sources
from skinsource.specs.samples import Samples
from skinsource.design.view import View
from skinsource.design.waveforms.clicks import Clicks
from skinsource_gui.panels.inspector.panel import InspectorPanel
from skinsource_gui.fields.editors import FieldCell

path = Path(sys.argv[1])
older = open_design(sys.argv[2])
assert older.view.bookmark_s == 0.25, "the file knew nothing of it"
assert older.design.inputs[0].label == ""
drawn = Samples(values=np.arange(4.0), sample_rate_hz=1300.0)
clicks = Clicks(gap_s=0.04, name="touché", envelope=((0.0, 0.5), (0.5, 1.0)), drawn=drawn)
design = Design(limb="synthetic-1", inputs=(track(location=7, waveform=clicks, label="first"),))
view = View(bookmark_s=0.75)
save_design(path, design, view)
opened = open_design(path)
assert opened.design == design and opened.view == view
levels = new_graph().evaluate({"output_levels_db"}, sources(design, view))["output_levels_db"]
assert np.isfinite(levels).any()
other = change_kind(design, view, design.ids, "Tone")
back = change_kind(other.design, other.view, other.design.ids, "Clicks")
assert type(back.design.inputs[0].clips[0].waveform) is Clicks
application = QApplication([])
panel = InspectorPanel()
panel.show_state(design, replace(view, selected_inputs=design.ids))
cells = {cell.name: cell.field for cell in panel.findChildren(FieldCell)}
assert cells["gap_s"].value_si == 0.04
assert cells["name"].text() == "touché"
assert cells["envelope"].line.text() == "0 0.5; 500 1"
assert cells["drawn"].text().startswith("4 at 1300 Hz")
print("all of it works")
"""


def test_a_new_waveform_is_a_file_and_a_name_and_a_new_field_is_a_line(
    make_copy, tmp_path, older_design
):
    copy = make_copy()
    # A file in waveforms and a name in MORE.
    copy.write(copy.library / "design" / "waveforms" / "clicks.py", CLICKS)
    kinds = copy.library / "design" / "waveforms" / "__init__.py"
    line = "from skinsource.design.waveforms.periodic import PulseTrain, Saw, Square, Triangle\n"
    copy.insert(kinds, line, "from skinsource.design.waveforms.clicks import Clicks\n")
    copy.insert(kinds, "    Impulse,\n", "    Clicks,\n")
    # A line in Input and one in View.
    label = 'label: str = fields.text("", TextSpec(label="Label", longest=20))\n'
    copy.insert(copy.library / "design" / "design.py", "    muted: bool = fields", f"    {label}")
    bookmark = 'bookmark_s: float = fields.number(0.25, NumberSpec(label="Bookmark"))\n'
    copy.insert(
        copy.library / "design" / "view.py", "    delay_removed: bool = fields", f"    {bookmark}"
    )
    output = copy.run(TRY, tmp_path / "new.skinsource", older_design)
    assert output == "all of it works\n"
