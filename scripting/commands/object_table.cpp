#include "scripting/commands/object_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>

namespace stampede::program {
namespace {

// Whole millimetres, written in metres.
std::string size_of(const Vector3& size) { return fmt::format("{:.3f} {:.3f} {:.3f}", size.x(), size.y(), size.z()); }

std::string moves(const Joint& joint) {
  constexpr double kDegree = std::numbers::pi / 180;
  switch (joint.kind) {
    case JointKind::slider:
      return fmt::format("slides {:g} … {:g} m", joint.lower, joint.upper);
    case JointKind::hinge:
      return fmt::format("turns {:.0f} … {:.0f} deg", joint.lower / kDegree, joint.upper / kDegree);
    case JointKind::screw:
      return fmt::format("screws {:.0f} … {:.0f} deg", joint.lower / kDegree, joint.upper / kDegree);
    default:
      return "";
  }
}

std::string motion_of(const Scene& scene, const Object& object) {
  if (object.kind == ObjectKind::region) return "";
  if (object.kind == ObjectKind::part) {
    const Body& body = scene.bodies.at(static_cast<std::size_t>(scene.body_index(object.body)));
    return moves(body.parts.at(static_cast<std::size_t>(object.part)).joint);
  }
  const bool movable = std::ranges::find(object.traits, "movable") != object.traits.end();
  return movable ? "free" : "stands still";
}

std::string numbers_of(const Object& object) {
  std::vector<std::string> texts;
  for (const auto& [name, value] : object.numbers) texts.push_back(fmt::format("{} {:.4g}", name, value));
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace

QueryResult object_table(const Scene& scene) {
  QueryResult table;
  table.columns = {"name", "kind", "type", "traits", "size_m", "moves", "numbers"};
  for (const Object& object : scene.objects)
    table.rows.push_back({object.name, std::string(to_string(object.kind)), object.type,
                          fmt::format("{}", fmt::join(object.traits, " ")), size_of(object.size),
                          motion_of(scene, object), numbers_of(object)});
  return table;
}

}  // namespace stampede::program
