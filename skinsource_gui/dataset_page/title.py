"""What the page is called, wherever the way to it is told."""

TITLE = "Get the measured limbs"
