"""Desktop studio around the `skinsource` library."""
