"""The window around the panels: menus, actions, palette, arrangements, pages."""
