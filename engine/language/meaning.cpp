#include "engine/language/meaning.h"

#include <algorithm>

namespace stampede {

ThingRoles& ThingRoles::operator|=(const ThingRoles& other) {
  for (const ThingRole role : {&ThingRoles::wanted, &ThingRoles::handled, &ThingRoles::moved, &ThingRoles::accessory,
                               &ThingRoles::tool, &ThingRoles::source, &ThingRoles::destination})
    this->*role |= other.*role;
  return *this;
}

const SpokenThing* Meaning::thing(const std::string& name) const {
  const auto found =
      std::find_if(things.begin(), things.end(), [&](const SpokenThing& one) { return one.name == name; });
  return found == things.end() ? nullptr : &*found;
}

bool Meaning::carries() const {
  return std::any_of(things.begin(), things.end(), [](const SpokenThing& one) { return one.roles.moved; });
}

bool is_part_of(const std::string& name, const std::string& whole) {
  return name.size() > whole.size() && name[whole.size()] == '.' && name.starts_with(whole);
}

}  // namespace stampede
