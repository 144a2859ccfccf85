"""File > Own limbs: what a lab measured itself, imported, listed, mirrored, removed."""
