// What stood in the way where a skill or a start found nothing to take or no place, or failed later: all it looked at.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/base/reason.h"
#include "engine/model/scene_poses.h"
#include "engine/motion/looked.h"

namespace stampede {

class WorldView;

struct Impasse {
  std::string task, variation;
  std::int64_t seed = 0;
  std::string step;  // `pick block1 table panda.hand`; of a start `init`
  Reason reason = Reason::no_grasp;
  std::string detail;          // as the record says it
  std::string subject;         // the object that was to be taken or placed
  std::vector<Looked> looked;  // of no_grasp their poses are of the hand's tip, else of the subject's body
  int draws = 1;               // of a start: how many failed of this
  std::shared_ptr<const Scene> scene;
  SceneState state;  // of that moment
};

SceneState state_of(const WorldView& view);

}  // namespace stampede
