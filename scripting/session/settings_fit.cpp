#include "scripting/session/settings_fit.h"

#include "engine/base/names.h"
#include "engine/base/nearest.h"

namespace stampede {

std::map<std::string, CallSettings> settings_from(const std::vector<std::string>& texts, const Library& library,
                                                  const std::string& place) {
  std::map<std::string, CallSettings> all;
  for (const std::string& text : texts) add_skill_setting(text, all, place);
  for (const auto& [name, set] : all) {
    if (name == kOfMotions) {
      check_motion_settings(set, place);
      continue;
    }
    if (const SkillInfo* skill = library.skill(name)) {
      check_settings(*skill, set, place);
      continue;
    }
    throw Error(place, "there is no skill '" + name + "'",
                did_you_mean(name, names_of(library.files(DefinitionKind::skill))));
  }
  return all;
}

}  // namespace stampede
