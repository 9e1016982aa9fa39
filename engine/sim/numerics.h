// A hash of fixed sums that tells processors and mathematical libraries apart.
#pragma once

#include <string>

namespace stampede {

// Same digits, same promise: catalogues replay bit for bit where this is the same. Repeatable within a machine.
std::string numerics_probe();

}  // namespace stampede
