"""The words that crowds are made of: the vocabulary, the brief, and sentences as vectors.

In: what a user says. Out: `Brief`, `Action`, `Category`, text embeddings, replies of a language model.
May import: errors. Never: places, clocks, graphs.
Only `words.embed` loads language encoders, and only when one is asked for. Only `words.providers` talks to a network.
"""
