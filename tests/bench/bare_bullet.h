// What a minimal program on Bullet's own multibody world would do with a scene of a robot, what stands still and free
// bodies: the same bodies, shapes, motors and settings, targets, stepSimulation, nothing else.
#pragma once

#include <memory>

#include "engine/model/scene.h"
#include "engine/model/trajectory.h"

namespace stampede {

class BareBullet {
 public:
  explicit BareBullet(const Scene& scene);  // whose robot has two fingers; further articulated bodies are left out
  ~BareBullet();
  void step(const JointState& target);  // 1 / physics_hz

 private:
  struct Impl;
  struct NotOneBody;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stampede
