#include "engine/start/margins.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/record/observation.h"

namespace stampede {
namespace {

std::string unit_of_joint(const Fact& fact, const WorldView& view) {
  if (fact.arguments.empty() || view.object(fact.arguments[0]).kind == ObjectKind::region) return kUnitOfJoint;
  const PartRef part = view.part_of(fact.arguments[0]);
  const Joint& joint = view.scene().body_at(part.body).parts[static_cast<std::size_t>(part.part)].joint;
  return joint.kind == JointKind::hinge || joint.kind == JointKind::screw ? "rad" : "m";
}

// As it comes back from a catalogue: there is one zero.
double storable(const std::optional<double>& margin) {
  return margin && std::isfinite(*margin) ? *margin + 0.0 : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Margins::Margins(Symbols& symbols, const std::vector<Fact>& atoms, const WorldView& view) : symbols_(&symbols) {
  for (const Fact& atom : atoms) {
    const std::string unit = symbols.traits(atom.predicate).margin_unit;
    if (unit.empty()) continue;
    atoms_.push_back(atom);
    units_.push_back(unit == kUnitOfJoint ? unit_of_joint(atom, view) : unit);
  }
}

ChannelRecord Margins::channel(double rate_hz) const {
  ChannelRecord channel;
  channel.name = kMargins;
  channel.rate_hz = rate_hz;
  for (const Fact& atom : atoms_) channel.components.push_back(to_text(atom));
  const bool one = std::all_of(units_.begin(), units_.end(), [&](const auto& unit) { return unit == units_[0]; });
  for (std::size_t i = 0; i < (one ? std::min<std::size_t>(1, units_.size()) : units_.size()); ++i)
    channel.unit += (i > 0 ? ", " : "") + units_[i];
  return channel;
}

std::vector<double> Margins::read(const WorldView& view, const std::map<Fact, Symbols::Value>& known) const {
  std::vector<double> margins;
  for (const Fact& atom : atoms_) {
    const auto found = known.find(atom);
    const bool read = found != known.end() && found->second.margin;
    margins.push_back(storable(read ? found->second.margin : symbols_->value(atom, view).margin));
  }
  return margins;
}

}  // namespace stampede
