"""Measures: how close a crowd of generated groups is to a crowd of authored ones, and the report that says so.

In: a `GraphSource`, authored samples. Out: divergences beside their floors, adherence, baselines, an `Evaluation`.
May import: learn and everything below. Never: pipeline, cli.
"""
