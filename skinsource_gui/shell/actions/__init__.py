"""The one table of what can be done: menus, shortcuts, the palette and the keys page use it.

Each menu has a module here, whose table holds its entries in their order.
"""

from dataclasses import replace

from skinsource_gui.qt.keys import SHORTCUTS
from skinsource_gui.shell.actions.clip_menu import CLIP
from skinsource_gui.shell.actions.edit_menu import EDIT
from skinsource_gui.shell.actions.file_menu import EXPORT_ENTRIES, FILE
from skinsource_gui.shell.actions.help_menu import HELP
from skinsource_gui.shell.actions.play_menu import PLAY
from skinsource_gui.shell.actions.spec import ActionSpec
from skinsource_gui.shell.actions.view_menu import VIEW

MENUS = {"File": FILE, "Edit": EDIT, "Clip": CLIP, "View": VIEW, "Play": PLAY, "Help": HELP}
#: Those without a menu are found by the palette and by their keys.
ACTIONS: tuple[ActionSpec, ...] = (
    *(replace(spec, menu=title) for title, specs in MENUS.items() for spec in specs),
    *EXPORT_ENTRIES,
)
SHORTCUTS.update({spec.name: spec.keys for spec in ACTIONS})
