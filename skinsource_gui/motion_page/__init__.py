"""Edit > Motion…: what seems to move over the skin, chosen and shown before it is kept."""
