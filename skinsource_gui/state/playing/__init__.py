"""Playing, as the window does it: devices away from the GUI thread, the playhead in step."""
