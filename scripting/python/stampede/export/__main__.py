"""`python -m stampede.export`."""

import sys

from stampede._core import Error
from stampede.export import export

try:
    export()
except (Error, ImportError) as error:
    sys.exit(f"error: {error}")
except KeyboardInterrupt:
    sys.exit("interrupted: the same command goes on with it")
