// Continuous parameters and controllers that a caller sets: read from text, checked, said as text.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/model/operation.h"

namespace stampede {

struct SkillInfo;

// What a caller sets of a skill's call instead of leaving it to be drawn.
struct CallSettings {
  struct Value {
    std::string parameter;  // a declared continuous one
    int component = 0;      // from 1; 0: all of it
    std::vector<double> values;
    friend bool operator==(const Value&, const Value&) = default;
  };
  std::vector<Value> values;  // later ones win
  std::optional<ControllerKind> controller;
  bool empty() const { return values.empty() && !controller; }
  friend bool operator==(const CallSettings&, const CallSettings&) = default;
};

// Throws Error, at `place`: an unknown parameter or component (with the names that there are), another number of values
// than the parameter has, a value out of its bounds or not finite. A pose has 7 values (x y z, quaternion x y z w) in
// the world, a grasp 7 or 8: the tip in the object's frame, and the opening at contact.
void check_settings(const SkillInfo& skill, const CallSettings& set, const std::string& place);

// `height=0.2`, `direction=0,0,1`, `direction.3=1`, `controller=joint_impedance`. Throws Error for other text and for
// unknown controllers.
void add_setting(std::string_view name, std::string_view value, CallSettings& set, const std::string& place);

// The same with the skill before it: `pick.height=0.2`.
void add_skill_setting(std::string_view text, std::map<std::string, CallSettings>& set, const std::string& place);

// What `add_skill_setting` reads, one after the other with blanks between them.
std::string to_text(const std::map<std::string, CallSettings>& set);

// `motion.stop_at_vias=1`: the arm stands at each via-point and where its way bends, so that readers who find keyframes
// by stops find them all. Set like a skill's parameters, of every motion.
inline constexpr const char* kOfMotions = "motion";
void check_motion_settings(const CallSettings& set, const std::string& place);
bool stops_at_vias(const std::map<std::string, CallSettings>& all);

}  // namespace stampede
