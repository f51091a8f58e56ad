"""An answer shown: its JSON, the extended model as a scenario, figures, one page, a notebook."""
