"""From named parameters to the vector ``p``, and which of them cannot stand side by side.

It begins with ``v``, the value of every parameter in SI units or as its name says (`V_*`), and
``d``, standard random numbers (`D_*`): `vector.pack` makes ``p`` of them, `contradictions` judges
``v``. Like the rest of the kernel it is scalar code on flat arrays.
"""
