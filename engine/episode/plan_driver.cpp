// A plan to its end, or to the first failure.
#include "engine/episode/drivers.h"

namespace stampede {

SkillResult follow_plan(Drive& drive) {
  for (std::size_t i = 0; i < drive.plan.size(); ++i) {
    drive.track.here();
    SkillResult result = drive.track.run(drive.plan.next(i), i, drive.plan.set(i), drive.plan.mode(i));
    if (result.ok()) result = drive.plan.watch(i + 1, result.segment);
    if (!result.ok()) return result;
  }
  drive.track.here();
  return drive.track.finish_goal(drive.plan.size());
}

}  // namespace stampede
