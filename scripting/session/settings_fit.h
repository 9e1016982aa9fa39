// What a caller sets of all calls of a skill, as text, against the skills that there are.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/start/call_settings.h"
#include "scripting/library/library.h"

namespace stampede {

// Of texts such as `pick.height=0.2`; later ones win. Throws Error, at `place`, for unknown skills, parameters and
// controllers, with the names that there are, and for values out of their bounds.
std::map<std::string, CallSettings> settings_from(const std::vector<std::string>& texts, const Library& library,
                                                  const std::string& place);

}  // namespace stampede
