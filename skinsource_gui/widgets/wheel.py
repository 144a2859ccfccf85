"""What a notch of the mouse wheel does, the same in plots, maps and numbers."""

#: How far Qt says the wheel has turned at each notch: eighths of a degree.
NOTCH = 120.0
#: How many times larger a plot or a map becomes with each notch.
ZOOM_PER_NOTCH = 1.2
