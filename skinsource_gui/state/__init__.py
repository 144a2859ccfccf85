"""What the window shows and works with: document, engine, conductor, jobs, playback."""
