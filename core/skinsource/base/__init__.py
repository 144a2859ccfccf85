"""What all rooms need: errors, files, jobs and constants of the published limbs."""
