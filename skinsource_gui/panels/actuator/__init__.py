"""The actuator panel."""
