"""A foreign laboratory: measured campaigns made without the product's model, laws or integrators.

Nothing in here imports the product. apparatus, forces, friction_law and contacts are the physics,
simulation runs it; laws, out_of_catalogue and held_back are what can be hidden; plans draws rigs
and runs, recording is the camera; size says how large a hidden thing is; campaign puts one
together and writes it; suites are the benchmarks.
iwan is a fifth contact, with everything of its own: elements, curves, fresh_laws, fresh_kinds,
cold_room (rigs and cameras) and iwan_suites. Nothing of it is in the other suites.
"""
