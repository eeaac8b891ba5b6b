"""Measures: how close a crowd of generated graphs is to a crowd of authored ones.

In: lists of `CrowdGraph`. Out: numbers with their floors.
May import: world and everything below. Never: learn, pipeline, cli.
"""
