"""Files of designs: opening, saving, autosave, exports."""
