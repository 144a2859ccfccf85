"""How recipes are computed: sums of harmonics, phases of sweeps."""
