"""A sentence becomes a world; the story of one group, and where everybody is after two minutes."""

import genc

world = genc.populate(
    "Around the park pond, families feed the ducks and friends meet on the benches", n_agents=20, minutes=5, seed=1
)
print("\n".join(genc.tell_group(world, 0)))

frame = round(120 / world.motion.dt_s)
for agent, (x, y) in enumerate(world.motion.positions_m[frame].tolist()):
    if world.motion.present[frame, agent]:
        print(f"person {agent} of group {world.plan.people[agent].group} at {x:.1f}, {y:.1f} m")
