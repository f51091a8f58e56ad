"""Coupling, studies and the command line."""
