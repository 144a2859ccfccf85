"""File > Import recording: what is in a file, what is taken of it, and where it goes."""
