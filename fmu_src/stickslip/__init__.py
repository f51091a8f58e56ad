"""Mechanics of an ice block on four springs and a moving surface."""
