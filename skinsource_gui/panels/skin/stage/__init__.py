"""Where everything of the map lies on the screen."""
