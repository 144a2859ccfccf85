"""Panel of large maps side by side: of limbs, or of snapshots."""
