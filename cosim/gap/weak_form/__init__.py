"""The equation of motion tested against the tracks themselves, without integrating the model.

    m x'' + F(x) = N mu(...) + ...

is multiplied by test functions that live inside a slip and integrated by parts, so that no
derivative of the data is needed, and whitened by the exact covariance of the tracker's noise
(Messenger & Bortz, Multiscale Model. Simul. 19, 2021; Bortz, Messenger & Dukic, Bull. Math. Biol.
85:110, 2023). What is unknown is then linear: `columns` says what each unknown does to the rows,
`evidence` how probable the rows are with it, `ladder` which unknowns the runs ask for.
"""
