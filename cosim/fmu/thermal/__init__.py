"""BeltIceThermal as units: the whole model by way of pythonfmu, and reduced, in C."""
