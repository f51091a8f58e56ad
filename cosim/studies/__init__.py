"""Questions that take many runs, a room each: the runs, what follows from them, its figures."""
