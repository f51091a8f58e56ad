"""Effects from outside: one Python file with a declared law each, to stand behind the catalogue.

A file is executed: whoever names one runs its author's code. `load` makes an effect of a file,
`check` holds its terms to what can become C, `template.py` is what `stickslip effect new` writes.
"""
