"""A sample-split F-test of what a linear regression form of the model lacks, and its problem."""
