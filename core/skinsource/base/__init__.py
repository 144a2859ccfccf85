"""Errors, checks of arguments, files, jobs and constants of the published limbs."""
