"""Edit > Save to library…: what is kept, and under which name; and presets that are dropped."""
