"""Plots, maps, figures and the pictures of them."""
