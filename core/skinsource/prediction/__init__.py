"""What `skinsource.predict` does: vibrations by any samples, for scripts."""
