"""What happens where, as an author wrote it: scenarios, their scripts, and the records of a rehearsal.

In: scripts, JSON, replies of a language model. Out: `Scenario`, `Record`.
May import: words, errors. Never: a clock in what it gives (a rehearsal keeps its own), paths, torch.
"""
