"""What a pressed button does on the timeline, one file for each kind."""
