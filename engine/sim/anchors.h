// Keeps the normals of anchored contacts true while the touching bodies turn together.
#pragma once

#include <LinearMath/btMatrix3x3.h>

#include <vector>

class btCollisionDispatcher;
class btCollisionWorld;

namespace stampede {

// Bullet keeps an anchored contact point for as long as it sticks, and with it the normal in world axes of the step in
// which it was made: a hand that has turned by 60 degrees still pushes along the old normal, and what it holds sticks
// to a finger that opens. So the kept normals turn with their body, once a step.
class AnchorNormals {
 public:
  void before_step(const btCollisionWorld& world);  // remembers how everything is turned
  void after_step(btCollisionDispatcher& dispatcher);

 private:
  std::vector<btMatrix3x3> before_;  // by the object's index in the world
};

}  // namespace stampede
