"""What lies over another widget."""
