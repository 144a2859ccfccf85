"""Export of a stimulus to files: prepared once, shown, written whole or not at all."""
