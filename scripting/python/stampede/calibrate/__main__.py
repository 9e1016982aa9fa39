"""`python -m stampede.calibrate`."""

import sys

from stampede._core import Error
from stampede.calibrate import calibrate

try:
    print(calibrate()[0])
except (Error, ImportError) as error:
    sys.exit(f"error: {error}")
except KeyboardInterrupt:
    sys.exit("interrupted: nothing was written")
