"""Export of stimuli."""
