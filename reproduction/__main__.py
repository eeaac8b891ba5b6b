"""Every experiment, one after another.

python -m reproduction              writes all results anew
python -m reproduction --check      compares with the results on record
python -m reproduction 02 07        only these
"""

from __future__ import annotations

from reproduction.study import door, experiments

if __name__ == "__main__":
    door(experiments(), __doc__)
