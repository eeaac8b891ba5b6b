"""Learning: scripts become a dataset, a dataset becomes a trained generator.

In: scenarios. Out: dataset folders, checkpoints.
May import: world and everything below. Never: evaluate, pipeline, cli.
"""
