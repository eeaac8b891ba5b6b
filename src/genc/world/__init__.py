"""The finished world: one file, and everything that can be read out of it.

In: `CrowdPlan`, `Motion`, provenance. Out: a `World`, its file, its stories.
May import: motion, plan, graph, scenario, words, errors. Never: decisions about what people do, torch.
"""
