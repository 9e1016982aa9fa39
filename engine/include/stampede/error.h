// Bad input: where it is, what is wrong with it, and how to cure it. (Installed, this file is the class itself.)
#pragma once

#include "engine/base/error.h"
