"""A tracker's file as numbers in SI units: which column is what, and in which unit."""
