"""The panel of all that lies between the design and the skin."""
