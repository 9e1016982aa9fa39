"""`python -m stampede.recordings`."""

import sys

from stampede._core import Error
from stampede.recordings import convert

try:
    for folder in convert():
        print(folder)
except (Error, ImportError) as error:
    sys.exit(f"error: {error}")
except KeyboardInterrupt:
    sys.exit("interrupted: nothing half written was left")
