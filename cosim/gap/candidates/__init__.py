"""The catalogue of effects as candidates: what a fit may turn to add each of them."""
