"""Measures: how close a crowd of generated groups is to a crowd of authored ones.

In: lists of `CrowdGraph`, briefs. Out: divergences beside their floors, adherence, two baselines.
May import: world and everything below. Never: learn, pipeline, cli.
"""
