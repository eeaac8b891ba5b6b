from __future__ import annotations

from hypothesis import settings

# A busy machine is no fault of the code: how long an example takes is not what the properties are about.
settings.register_profile("genc", deadline=None)
settings.load_profile("genc")
