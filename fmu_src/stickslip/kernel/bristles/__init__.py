"""A contact that is sheared before it slides, as if by bristles: the law, its events, its steps."""
