"""An answer shown: its JSON, the extended model as a scenario, figures and one page."""
