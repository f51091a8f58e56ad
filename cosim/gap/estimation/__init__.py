"""Parameters fitted to measured runs by multiple shooting (Bock 1983).

A stick-slip record is compared with the model in segments of a few cycles. Each segment starts from
a state that is itself fitted to the data (in a stick: the position alone), so that a small error
of the period does not add up over a run and swamp everything else. What is left is the normalised
residual: its mean square is chi-square per sample, 1 for measurement noise alone.
"""
