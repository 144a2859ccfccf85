"""The one table of what can be done: menus, shortcuts, the palette and the keys page use it.

Each menu has a module here, whose table holds its entries in their order.
"""

from skinsource_gui.qt.keys import SHORTCUTS
from skinsource_gui.shell.actions.edit_menu import EDIT
from skinsource_gui.shell.actions.file_menu import FILE
from skinsource_gui.shell.actions.help_menu import HELP
from skinsource_gui.shell.actions.play_menu import PLAY
from skinsource_gui.shell.actions.spec import ActionSpec
from skinsource_gui.shell.actions.view_menu import VIEW

MENUS = ("File", "Edit", "View", "Play", "Help")
ACTIONS: tuple[ActionSpec, ...] = (*FILE, *EDIT, *VIEW, *PLAY, *HELP)
SHORTCUTS.update({spec.name: spec.keys for spec in ACTIONS})
