"""CONTRIBUTING's recipes for a panel, an export, an action and a quantity, followed in one copy."""

import json

import pytest

RULE = '''
def loudest_level_db(output_levels_db: Floats) -> float:
    """Level of the loudest output, dB."""
    return float(np.nanmax(output_levels_db))


'''
SETTINGS = '''
"""What only the panel of the loudest output looks at."""

from dataclasses import dataclass

from skinsource.specs import fields
from skinsource.specs.fields import NumberSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class LoudestSettings:
    """How many ``digits`` the level has."""

    digits: int = fields.number(1, NumberSpec(label="Digits", minimum=0, maximum=6, whole=True))

    def __post_init__(self) -> None:
        fields.check(self)
'''
PANEL = '''
"""The level of the loudest output."""

from PySide6.QtWidgets import QLabel, QVBoxLayout

from skinsource.design.panel_settings import settings_of
from skinsource_gui.state.panel import Panel
from skinsource_gui.panels.loudest.settings import LoudestSettings


class LoudestPanel(Panel):
    """Shows one number."""

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
'''
EXPORT = '''
"""The level of the loudest output, as a file."""

from skinsource.base.job import never, silent
from skinsource.engine.evaluation import Evaluator


def export_loudest(path, design, view, *, progress=silent, stop=never, largest_error=0.0):
    """Write one number."""
    results = Evaluator().evaluate(design, ("loudest_level_db",), view)
    path.write_text(f"{results['loudest_level_db']!r}")
'''
TRY = """
import json, sys
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QEventLoop, QPoint, QRect
from PySide6.QtWidgets import QApplication, QFileDialog, QMenu, QTextBrowser

import skinsource as ss
from skinsource_gui.state.preferences import start_design
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource_gui.panels.loudest.settings import LoudestSettings
from skinsource_gui.app.app import make_application
from skinsource_gui.shell.workspaces import WORKSPACES
from skinsource_gui.shell.menus import Palette
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import Preferences

folder, facts = Path(sys.argv[1]), {}
design = start_design("synthetic-1")
facts["evaluated"] = ss.evaluate(design, "loudest_level_db")["loudest_level_db"]
application = make_application()
window = MainWindow(design, preferences=Preferences(folder / "studio.ini"), available_limbs=())
window.resize(1366, 728)
window.show()
panel, dock = window.panel("loudest"), window.docks["loudest"]

def settle():
    application.processEvents()
    window.catch_up()
    application.processEvents()

def over(part, others):
    place = QRect(part.mapTo(window, QPoint(0, 0)), part.size())
    return [widget.objectName() for widget in others if widget is not part and widget.isVisible()
            and place.intersects(QRect(widget.mapTo(window, QPoint(0, 0)), widget.size()))]

facts["places"] = {}
for arrangement in WORKSPACES:
    window.do(f"arrange_{arrangement.name}")
    dock.bring_forward()
    settle()
    place = QRect(dock.mapTo(window, QPoint(0, 0)), dock.size())
    bars = [window.menuBar(), window.findChild(object, "setup"), window.statusBar()]
    facts["places"][arrangement.name] = {
        "visible": dock.isVisible() and panel.visibleRegion().boundingRect().height() > 0,
        "area": panel.width() * panel.height(),
        "size": [window.width(), window.height()],
        "inside": window.rect().contains(place),
        "over": over(dock, [*bars, *window.docks.values()]),
        "words": panel.words.text(),
    }
menus = {menu.title().replace("&", ""): [entry.text() for entry in menu.actions()]
         for menu in window.findChildren(QMenu)}
facts["menus"] = {title: menus[title] for title in ("File", "Edit", "Panels")}

def listed(letters):
    window.do("find_action")
    palette = window.findChildren(Palette)[-1]
    palette.line.setText(letters)
    texts = [palette.list.item(row).text() for row in range(palette.list.count())]
    palette.close()
    return texts

facts["palette"] = {letters: listed(letters) for letters in ("loudest", "silence all")}
window.do("show_keys")
facts["keys"] = window.findChildren(QTextBrowser, "page_text")[-1].toPlainText()

# The action, with its condition.
action = window.actions_by_name["silence_all"]
facts["enabled"] = [action.isEnabled()]
action.trigger()
facts["muted"] = [track.muted for track in window.document.design.inputs]
window.document.undo_stack.undo()
window.do("clear_inputs")
facts["enabled"].append(action.isEnabled())
window.document.undo_stack.undo()

# The settings: seen, saved, and there again.
view = with_settings(window.document.view, "loudest", LoudestSettings(digits=4))
window.document.look(view)
settle()
facts["four_digits"] = panel.words.text()
path = folder / "a.skinsource"
ss.save_design(path, window.document.design, window.document.view)
window.document.look(with_settings(view, "loudest", LoudestSettings()))
window.document.mark_saved(window.document.path)
window.files.open(path)
settle()
facts["restored"] = [panel.settings.digits, panel.words.text()]
facts["old_file"] = settings_of(ss.open_design(sys.argv[2]).view, "loudest", LoudestSettings).digits

# The export.
target = folder / "loudest.txt"
QFileDialog.getSaveFileName = staticmethod(lambda *words, **more: (str(target), ""))
loop = QEventLoop()
window.runner.done.connect(loop.quit)
window.runner.failed.connect(loop.quit)
window.do("export_loudest")
loop.exec()
facts["written"] = float(target.read_text())
window.close_unasked()
print(json.dumps(facts))
"""
ACTION = """    action(
        "silence_all",
        "Edit",
        "Silence all",
        "Mute every input",
        "Ctrl+Alt+M",
        edit=lambda design, view: edits.mute_inputs(design, view, design.ids, True),
        enabled=_has_inputs,
    ),
"""
EXPORTED = """    ExportSpec(
        name="loudest",
        title="loudest level…",
        file_name="loudest.txt",
        kinds=(("Text", ".txt"),),
        hint="Save the level of the loudest output",
        write=export_loudest,
    ),
"""


@pytest.fixture(scope="module")
def facts(make_copy, tmp_path_factory, older_design):
    """What the studio is like in which all four recipes were followed."""
    copy = make_copy()
    # A function, and its name among the rules.
    quantities = copy.library / "engine" / "quantities.py"
    copy.insert(quantities, "def response_time_s(", RULE.lstrip())
    copy.insert(quantities, "    *voice_rules.RULES,\n", "    loudest_level_db,\n")
    # A folder, and a line (and the imports that it needs).
    folder = copy.studio / "panels" / "loudest"
    copy.write(folder / "__init__.py", '"""The loudest output."""\n')
    copy.write(folder / "settings.py", SETTINGS)
    copy.write(folder / "panel.py", PANEL)
    panels = copy.studio / "shell" / "panels.py"
    imported = "from skinsource_gui.panels.skin.settings import SkinSettings\n"
    copy.insert(
        panels, imported, "from skinsource_gui.panels.loudest.settings import LoudestSettings\n"
    )
    line = (
        '    PanelSpec(panel=LazyPanel("loudest", "Loudest output"), settings=LoudestSettings),\n'
    )
    copy.insert(panels, '    PanelSpec(panel=LazyPanel("inspector"', line)
    # A module, and a line.
    export = copy.library / "export"
    copy.write(export / "loudest.py", EXPORT)
    exports = copy.studio / "pages" / "files" / "exports.py"
    copy.insert(
        exports,
        "from skinsource.base.job import Job, Progress, Stop\n",
        "from skinsource.export.loudest import export_loudest\n",
    )
    copy.insert(exports, '    ExportSpec(\n        name="field"', EXPORTED)
    # An entry.
    copy.insert(
        copy.studio / "shell" / "actions" / "edit_menu.py",
        '    action(\n        "shift_input_up"',
        ACTION,
    )
    output = copy.run(TRY, tmp_path_factory.mktemp("made"), older_design)
    return json.loads(output.splitlines()[-1])


def test_a_new_quantity_is_evaluated_by_the_library_and_for_a_panel(facts):
    assert facts["evaluated"] == pytest.approx(facts["written"])
    for place in facts["places"].values():
        assert place["words"] == f"{facts['evaluated']:.1f} dB"


@pytest.mark.parametrize("arrangement", ["design", "analysis", "presentation"])
def test_a_new_panel_has_a_place_in_each_arrangement(facts, arrangement):
    place = facts["places"][arrangement]
    assert place["visible"]
    assert place["area"] > 0
    assert place["size"] == [1366, 728]
    assert place["inside"]
    assert place["over"] == []


def test_a_new_panel_stands_in_the_menu_and_the_palette(facts):
    assert "Loudest output" in facts["menus"]["Panels"]
    assert "Hide panel: Loudest output" in facts["palette"]["loudest"]


def test_settings_of_a_new_panel_are_saved_with_the_design(facts):
    assert facts["four_digits"] == f"{facts['evaluated']:.4f} dB"
    assert facts["restored"] == [4, facts["four_digits"]]
    assert facts["old_file"] == 1


def test_a_new_export_stands_in_the_menu_and_the_palette_and_writes(facts):
    assert "Export loudest level…" in facts["menus"]["File"]
    assert "Export loudest level…" in facts["palette"]["loudest"]


def test_a_new_action_stands_in_the_menu_the_palette_and_the_keys_page(facts):
    assert "Silence all" in facts["menus"]["Edit"]
    assert facts["palette"]["silence all"] == ["Silence all"]
    assert "Silence all – Mute every input" in facts["keys"]
    assert "Ctrl+Alt+M" in facts["keys"]


def test_a_new_action_can_be_done_only_while_its_condition_holds(facts):
    assert facts["enabled"] == [True, False]
    assert facts["muted"]
    assert all(facts["muted"])
