"""How much the data speak for a model: laid along them, a linear mixed model about that, evidence.

A model is laid along the data with friction of every run and stretch its own; about that fit
residuals answer nearly linearly to everything, and the likelihood of the runs, with what is their
own integrated over (Laird & Ware, Biometrics 38, 1982), is algebra.
"""
