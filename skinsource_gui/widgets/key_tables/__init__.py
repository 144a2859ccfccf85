"""Which keys and gestures there are; what they do stands where they act."""
