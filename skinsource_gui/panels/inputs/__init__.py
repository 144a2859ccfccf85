"""The list of inputs."""
