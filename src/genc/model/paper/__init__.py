"""The `paper` generator: the dual VGAE of Gen-C as the text describes it, layer by layer and loss by loss.

In: `Brief`s. Out: `CrowdGraph`s by way of a real-valued adjacency and `genc.graph.repair`.
May import: graph, words, the rest of model. Never: places, seconds.

What the text leaves open is decided in the docstrings, under `The paper does not say:`; where the code does otherwise
than the text, under `Departs from the paper:`.
"""
