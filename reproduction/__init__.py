"""Every table and figure of the paper's evaluation, one numbered folder each: see README.md."""
