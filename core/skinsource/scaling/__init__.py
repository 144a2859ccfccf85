"""What an amplitude of 1 means, and the calibration that goes with it."""
