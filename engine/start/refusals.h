// Why draws of a start were refused: counted by what failed and by what kept it from holding, with cures.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/motion/looked.h"
#include "engine/start/options.h"
#include "engine/start/standing.h"
#include "engine/start/task.h"

namespace stampede {

class Symbols;

std::string text_of(const Literal& literal);  // `(not (on cube1 cube2))`

// Of one start, which is drawn again and again. What is costly, as to ask what keeps the arm from a grasp, waits until
// it is told: a start that is found in the end pays next to nothing. Lifetime: refers to both of its arguments.
class Refusals {
 public:
  Refusals(Symbols& symbols, const RunOptions& options) : symbols_(symbols), options_(options) {}

  // One of these for each draw that was not taken.
  void add(const std::string& what) { ++refused_[what].times; }
  void add(const Blocked& blocked);
  // `scene`: in which the literal failed; the same one again counts, and is not looked at again. `asked`: it stands in
  // the task's own init.
  void add_unmet(const Literal& literal, std::shared_ptr<const Scene> scene, bool asked);
  // No place for its first argument; `looked`: what its sample turned down.
  void add_no_place(const Literal& literal, std::shared_ptr<const Scene> scene, bool asked,
                    const std::vector<Looked>& looked);

  int only(const std::string& what) const;  // so many draws failed, all of this; 0: of something else too
  // So many failed in the same way, one after the other: the same contact of things placed alike.
  int same_moment() const { return same_moment_; }

  // All of it, as the record says it: `(reachable cup) failed 100 times: 61 out of reach (32 mm at least), 39 touch
  // chest; bring cup nearer to panda`. Tells the witness too.
  std::string tell(const Task& task, int draws, bool always_same);

 private:
  struct Refused {
    int times = 0;
    std::optional<Literal> literal;
    bool asked = false;
    std::optional<Blocked> blocked;  // the shallowest
    struct Failed {
      std::shared_ptr<const Scene> scene;
      int times = 0;
    };
    std::vector<Failed> scenes;          // the first of those in which it failed
    std::vector<Looked> why;             // of each of these draws the commonest cause, where one is known
    std::vector<Looked> looked;          // all, for pictures
    double missing = -1, distance = -1;  // of its margin, and from the arm: the least; negative: not known
  };
  Refused& refused(const Literal& literal, std::shared_ptr<const Scene> scene, bool asked);
  void look_again(Refused& one);
  std::string text_of(const std::string& what, const Refused& one) const;
  std::vector<std::string> cures(const Refused& one, int draws) const;
  void show(const Task& task, const std::string& what, Refused& one, const std::string& detail) const;

  Symbols& symbols_;
  const RunOptions& options_;
  std::map<std::string, Refused> refused_;  // by what failed
  std::string last_moment_;                 // of the last draw that was blocked
  int same_moment_ = 0;
};

}  // namespace stampede
