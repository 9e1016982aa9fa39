// Conditions that the arm was asked of in vain, for what no further draw changes: asked again once, not in each draw.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/model/scene.h"
#include "engine/start/predicates.h"
#include "engine/start/task.h"

namespace stampede {

// Of one start, which is drawn again and again. Lifetime: refers to the symbols.
class LastingRefusals {
 public:
  explicit LastingRefusals(Symbols& symbols) : symbols_(symbols) {}

  // The scene in which the condition was refused for good, where all that this was for stands in `now` as it stood
  // there; null: it has to be asked.
  std::shared_ptr<const Scene> scene_of(const Literal& condition, const Scene& now) const;

  // It was refused in this scene. Where it was in an earlier one too, in which the things that it names stood alike, it
  // is asked once with nothing there but what stood alike in both: what else there is can only be in the way. Refused
  // for good is what is then out of reach, and not by a hair: from wherever the arm starts.
  void add(const Literal& condition, std::shared_ptr<const Scene> scene);

 private:
  using Standing =
      std::pair<std::size_t, std::string>;  // a body, or behind them all the robot, and what it stands like
  struct Known {
    std::shared_ptr<const Scene> last;  // in which it was refused; null: it is of no use to ask any more
    std::vector<std::pair<std::shared_ptr<const Scene>, std::vector<Standing>>> for_good;
  };
  bool out_of_reach(const Literal& condition, const Scene& scene, const std::vector<Standing>& alike) const;

  Symbols& symbols_;
  std::map<std::string, Known> known_;  // by the condition's text
};

}  // namespace stampede
