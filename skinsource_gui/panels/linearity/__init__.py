"""Whether snapshots show proportion and superposition."""
