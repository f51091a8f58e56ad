"""From the declarations of the effects to the kernel: slots, calls of their terms, one text.

What the effects declare is read here and nowhere else. `check` refuses what no kernel can be made
of, `slots` gives each number its place in the kernel's arrays, `terms` writes the functions through
which the core calls the effects' terms, and those that make the effects' numbers from their
parameters and random draws, and `source` joins it all to the one text that runs interpreted and
inside the unit in Python. `c` makes C of that text, which `c_program` takes apart, with
`c_expressions`; `compiler` makes libraries of C.
"""
