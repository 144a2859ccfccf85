"""Recipes in a list: added, edited, put in another order, removed."""
