"""Panel of snapshots, limbs or axes, compared as maps."""
