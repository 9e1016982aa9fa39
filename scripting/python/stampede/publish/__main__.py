"""`python -m stampede.publish`."""

import sys

from stampede._core import Error
from stampede.publish import publish

try:
    publish()
except (Error, ImportError) as error:
    sys.exit(f"error: {error}")
except KeyboardInterrupt:
    sys.exit("interrupted: nothing half written was left")
