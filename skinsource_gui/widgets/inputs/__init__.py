"""What stands for an input: its colour, its words, its waveform."""
