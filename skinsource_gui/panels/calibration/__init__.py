"""A person is calibrated: mounting, sweeps, the focus, and whether it holds."""
