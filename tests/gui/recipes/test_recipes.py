"""CONTRIBUTING's recipes, followed to the letter in one copy of the project."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

PROJECT = Path(__file__).parents[3]
RULE = """def loudest_level_db(output_levels_db: Floats) -> float:
    return float(np.nanmax(output_levels_db))


"""
SETTINGS = """
from dataclasses import dataclass

from skinsource.specs import fields
from skinsource.specs.numbers import NumberSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class LoudestSettings:
    digits: int = fields.number(1, NumberSpec(label="Digits", minimum=0, maximum=6, whole=True))
"""
PANEL = """
from PySide6.QtWidgets import QLabel, QVBoxLayout

from skinsource.design.panel_settings import settings_of
from skinsource_gui.state.panel import Panel
from skinsource_gui.panels.loudest.settings import LoudestSettings


class LoudestPanel(Panel):
    name = "loudest"
    title = "Loudest output"

    def __init__(self, parent=None):
        super().__init__(parent)
        self.settings = LoudestSettings()
        self.words = QLabel("")
        QVBoxLayout(self).addWidget(self.words)

    @property
    def needs(self):
        return frozenset({"loudest_level_db"})

    def show_state(self, design, view):
        self.settings = settings_of(view, self.name, LoudestSettings)

    def show_results(self, results):
        self.words.setText(f"{results['loudest_level_db']:.{self.settings.digits}f} dB")
"""
ACTION = """[Edit.silence_all]
text = "Silence all"
hint = "Mute every input"
keys = "Ctrl+Alt+M"

"""
ACTION_EDIT = """\
    "silence_all": lambda design, view: edits.mute_inputs(design, view, design.ids, True),
"""
ACTION_ENABLED = """    "silence_all": lambda design, view: bool(design.inputs),
"""
CLICKS = '''
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from skinsource.specs import fields
from skinsource.specs.numbers import NumberSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class Clicks:
    """A click at each multiple of the gap."""

    title: ClassVar[str] = "Clicks"

    gap_s: float = fields.number(0.05, NumberSpec(label="Gap", unit="s", minimum=0.01, maximum=1.0))
    duration_s: float = fields.number(
        0.2, NumberSpec(label="Duration", unit="s", minimum=0.01, maximum=9.0)
    )

    def __post_init__(self) -> None:
        fields.check(self)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0):
        """Drive, (n_times,), of peak 1."""
        drive = np.zeros(round(self.duration_s * sample_rate_hz))
        drive[:: round(self.gap_s * sample_rate_hz)] = 1.0
        return drive
'''
TRY = """
import sys
from pathlib import Path

from PySide6.QtWidgets import QMenu

import skinsource as ss
from skinsource.design.design import Design, track
from skinsource.design.edits import change_kind
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.design import View
from skinsource.design.waveforms.clicks import Clicks
from skinsource_gui.app.app import make_application
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.panels.loudest.settings import LoudestSettings
from skinsource_gui.shell.workspaces import WORKSPACES
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import Preferences

folder = Path(sys.argv[1])

# The waveform and the fields: in files, among kinds, in the editor.
clicks = Clicks(gap_s=0.04)
design = Design(limb="synthetic-1", inputs=(track(location=7, waveform=clicks, label="first"),))
view = View(bookmark_s=0.75, selected_inputs=design.ids)
path = folder / "a.skinsource"
ss.save_design(path, design, view)
opened = ss.open_design(path)
assert (opened.design, opened.view) == (design, view)
other = change_kind(design, view, design.ids, "Tone")
back = change_kind(other.design, other.view, other.design.ids, "Clicks")
assert type(back.design.inputs[0].clips[0].waveform) is Clicks
loudest_db = ss.evaluate(design, "loudest_level_db")["loudest_level_db"]

application = make_application()
window = MainWindow(design, preferences=Preferences(folder / "studio.ini"), available_limbs=())
window.show()
window.document.look(view)
panel, dock = window.panel("loudest"), window.docks["loudest"]

def settle():
    application.processEvents()
    window.catch_up()
    application.processEvents()

settle()
cells = {cell.name: cell.field for cell in window.panel("inspector").findChildren(FieldCell)}
assert cells["gap_s"].value_si == 0.04

# The panel and its quantity, in each arrangement.
for arrangement in WORKSPACES:
    window.do(f"arrange_{arrangement.name}")
    dock.bring_forward()
    settle()
    assert dock.isVisible() and panel.visibleRegion().boundingRect().height() > 0
    assert panel.words.text() == f"{loudest_db:.1f} dB"

# Menus; what stands there is found in the palette and on the page of keys.
menus = {menu.title().replace("&", ""): [entry.text() for entry in menu.actions()]
         for menu in window.findChildren(QMenu)}
assert "Loudest output" in menus["Panels"]
assert "Silence all" in menus["Edit"]

# The action, with its condition.
action = window.actions_by_name["silence_all"]
assert action.isEnabled()
action.trigger()
assert all(track.muted for track in window.document.design.inputs)
window.document.undo_stack.undo()
window.do("clear_inputs")
assert not action.isEnabled()
window.document.undo_stack.undo()

# The settings: seen, saved, and there again.
window.document.look(with_settings(window.document.view, "loudest", LoudestSettings(digits=4)))
settle()
assert panel.words.text() == f"{loudest_db:.4f} dB"
ss.save_design(path, window.document.design, window.document.view)
assert settings_of(ss.open_design(path).view, "loudest", LoudestSettings).digits == 4

settle()
window.close_unasked()
print("all of it works")
"""


def write(path: Path, text: str) -> None:
    """Write a new file."""
    path.parent.mkdir(exist_ok=True)
    path.write_text(text.lstrip(), encoding="utf-8")


def insert(path: Path, before: str, new: str) -> None:
    """Write a line, as somebody would who follows the recipe."""
    text = path.read_text(encoding="utf-8")
    assert text.count(before) == 1, f"{before!r} in {path.name}"
    path.write_text(text.replace(before, new + before), encoding="utf-8")


def test_each_recipe_leads_to_what_it_says(tmp_path):
    # A copy of library and studio that may be changed.
    for name in ("core", "skinsource_gui", "data", "resources"):
        skipped = shutil.ignore_patterns("__pycache__")
        shutil.copytree(PROJECT / name, tmp_path / "copy" / name, ignore=skipped)
    copy = tmp_path / "copy"
    library, studio = copy / "core" / "skinsource", copy / "skinsource_gui"
    # A quantity: a function, and its name among the rules.
    quantities = library / "engine" / "quantities.py"
    insert(quantities, "def response_time_s(", RULE)
    insert(quantities, "    *_rules_of(voice_rules),\n", "    loudest_level_db,\n")
    # A panel: a folder, and a line (and the imports that it needs).
    folder = studio / "panels" / "loudest"
    write(folder / "__init__.py", '"""The loudest output."""\n')
    write(folder / "settings.py", SETTINGS)
    write(folder / "panel.py", PANEL)
    panels = studio / "shell" / "panels.py"
    imported = "from skinsource_gui.panels.skin.settings import SkinSettings\n"
    insert(panels, imported, "from skinsource_gui.panels.loudest.settings import LoudestSettings\n")
    line = (
        '    PanelSpec(panel=LazyPanel("loudest", "Loudest output"), settings=LoudestSettings),\n'
    )
    insert(panels, '    PanelSpec(panel=LazyPanel("inspector"', line)
    # An action: an entry, its edit and its condition.
    insert(copy / "resources" / "actions.toml", "[Edit.shift_input_up]", ACTION)
    actions = studio / "shell" / "actions.py"
    insert(actions, '    "shift_input_up": _of_inputs(', ACTION_EDIT)
    insert(actions, '    "select_no_outputs": lambda _, view', ACTION_ENABLED)
    # A waveform: a file and a name in MORE; a field: a line.
    write(library / "design" / "waveforms" / "clicks.py", CLICKS)
    kinds = library / "design" / "waveforms" / "__init__.py"
    imported = (
        "from skinsource.design.waveforms.periodic import PulseTrain, Saw, Square, Triangle\n"
    )
    insert(kinds, imported, "from skinsource.design.waveforms.clicks import Clicks\n")
    insert(kinds, "    Impulse,\n", "    Clicks,\n")
    label = '    label: str = fields.text("", TextSpec(label="Label", longest=20))\n'
    insert(library / "design" / "design.py", "    muted: bool = fields", label)
    bookmark = '    bookmark_s: float = fields.number(0.25, NumberSpec(label="Bookmark"))\n'
    insert(library / "design" / "design.py", "    delay_removed: bool = fields", bookmark)
    place = os.pathsep.join([str(copy / "core"), str(copy)])
    done = subprocess.run(
        [sys.executable, "-c", TRY, tmp_path],
        env={**os.environ, "PYTHONPATH": place, "QT_QPA_PLATFORM": "offscreen"},
        # Python looks there first.
        cwd=copy,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr[-3000:]
    assert done.stdout.endswith("all of it works\n")
