"""How an actuator answers, what an equaliser changes, and what the design asks of it."""
