"""A scenario written by hand is played as written, without a model."""

from pathlib import Path
from tempfile import TemporaryDirectory

import genc

SCRIPT = """
T: village fair
=== cake-stall
S: At the village fair, two friends meet at the cake stall while the baker serves.
L: gate | entrance | 0,0 | 4x2
L: cake stall | service area | 12,6 | 3x2
L: picnic table | furniture | 20,2 | 3x1
G: the baker sells cake all morning
1 - a: object interact@cake stall, wait@cake stall, object interact@cake stall
G: two friends share a cake
2 - a: enter/exit@gate, queue@cake stall, object interact@cake stall
3 - b: enter/exit@gate, sit@picnic table
4 >2 ab: meet@picnic table, discuss@picnic table
5 >4 ab: enter/exit@gate
"""

with TemporaryDirectory() as folder:
    path = Path(folder) / "fair.txt"
    path.write_text(SCRIPT)
    world = genc.stage(genc.load_scripts(path)[0], minutes=6)
for group in (0, 1):
    print("\n".join(genc.tell_group(world, group)))
