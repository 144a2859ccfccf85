"""Panel of snapshots side by side."""
