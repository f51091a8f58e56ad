"""Which effect the plain model lacks: refit, compare, allow for chance, or say unknown."""
