"""Playing a design on actuators through a sound card."""
