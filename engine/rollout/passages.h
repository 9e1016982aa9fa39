// When the tool passed the via-points of a motion.
#pragma once

#include <vector>

#include "engine/motion/motion.h"
#include "engine/record/record.h"

namespace stampede {

// Looks at the tool after each step of one motion.
class Passages {
 public:
  Passages(std::vector<PlannedVia> vias, int segment) : vias_(std::move(vias)), segment_(segment) {}
  void look(const World& world, std::int64_t clock = 0);  // clock: as of Motion
  // One passage a via: in the order of the vias, as near to all of them as that order allows, the earliest of equals.
  // Vias that the tool came no nearer than 5 cm are left out, and those passed by time that it did not come to.
  std::vector<ViaRecord> in_order() const;

 private:
  struct Sample {
    std::int64_t step = 0, clock = 0;
    Transform world_from_tip;
    double joint_speed = 0, tool_speed = 0;  // rad/s, m/s
  };
  std::vector<PlannedVia> vias_;
  int segment_ = 0;
  std::vector<Sample> samples_;
};

}  // namespace stampede
