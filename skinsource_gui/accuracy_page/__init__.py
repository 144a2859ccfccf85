"""Help > Accuracy and speed."""
