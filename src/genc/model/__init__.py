"""The generators: from a brief to new groups.

In: `Brief`s. Out: `CrowdGraph`s (`GraphSource`), trained weights.
May import: graph, scenario, words, errors. Never: places, seconds, files other than checkpoints.
"""
