from stampede._core import *
