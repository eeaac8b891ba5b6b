"""Who does what with whom, in order: the crowd scenario graph and its two other spellings.

In: records, tokens. Out: `CrowdGraph`, records, tokens.
May import: scenario, words, errors. Never: metres, seconds, torch.
"""
