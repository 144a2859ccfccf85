"""Panel of analysis: views of the prediction, one of which is chosen."""
