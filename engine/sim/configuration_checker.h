// Many configurations asked about: edges and paths.
#pragma once

#include <memory>
#include <span>

#include "engine/sim/collision_state.h"

namespace stampede {

// Answers as CollisionState::free does, many times faster: eight configurations at once are looked at through boxes and
// cylinders around the links and balls inside them, and what is neither surely free nor surely touching is asked
// exactly. So the answers are the same on every processor. Obstacles grow by a padding, one for each configuration.
// Holds working memory: one for each thread. Lifetime: borrows the state, which must not change meanwhile.
class ConfigurationChecker {
 public:
  explicit ConfigurationChecker(const CollisionState& state);
  ~ConfigurationChecker();
  ConfigurationChecker(ConfigurationChecker&&) noexcept;

  // Index of the first configuration that touches something; their number when none does.
  std::size_t first_touching(std::span<const JointVector> configurations, std::span<const double> padding_m);
  // Is none touching? The order is that of the looking: first what finds a contact early.
  bool all_free(std::span<const JointVector> configurations, std::span<const double> padding_m);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stampede
