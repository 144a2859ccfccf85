"""The panel of consecutive windows."""
