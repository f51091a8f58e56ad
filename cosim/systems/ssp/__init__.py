"""Systems in SSP files (System Structure and Parameterization, 1.0 and 2.0)."""
