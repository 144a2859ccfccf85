"""What rendering remembers of clips: their samples, and how the chains of tracks are placed."""
