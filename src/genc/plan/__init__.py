"""Where and when: groups become people with a timed row of activities at concrete slots.

In: records or graphs, an environment. Out: `CrowdPlan`.
May import: graph, scenario, words, errors. Never: paths, torch.
"""
