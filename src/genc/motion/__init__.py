"""People who move: a plan carried out in closed loop by a steering method.

In: `CrowdPlan`. Out: `Motion`.
May import: plan, graph, scenario, words, errors. Never: meaning (texts, themes), torch.
"""
