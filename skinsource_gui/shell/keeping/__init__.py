"""What sees to it that no work is lost."""
