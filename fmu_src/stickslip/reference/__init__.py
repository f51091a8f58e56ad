"""Classic stick-slip models and the source study's scheme, for comparison with the kernel."""
