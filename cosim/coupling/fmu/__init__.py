"""Units as files (FMUs) that take part in a coupled run, through fmpy."""
