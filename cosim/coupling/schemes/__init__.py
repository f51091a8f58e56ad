"""Coupling schemes: how the participants make a macro step together.

A scheme is a small class, a `Scheme`: it reads and writes values through the exchange
alone, so that a further one needs no change elsewhere.
"""
