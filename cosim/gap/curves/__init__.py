"""Effects as free curves over their axes: an independent vote on what is missing."""
