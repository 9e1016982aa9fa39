// Motions whose reference depends on what the arm meets, so that it is a set-point of its own each step. Room-internal.
#pragma once

#include <memory>
#include <string>

#include "engine/base/reason.h"
#include "engine/motion/motion.h"
#include "engine/motion/watch.h"

namespace stampede {

class Steering {
 public:
  struct Next {
    JointVector position, velocity;  // of the reference at the end of the coming step
    std::int64_t clock = 0;          // how far it has got along its trajectory, steps; may wait
    Reason reason = Reason::none;    // other than none: it gives up, `detail` says why
    std::string detail = {};
  };
  virtual ~Steering() = default;
  virtual Next next(const World& world, const ContactWatch& watch) = 0;  // once a physics step
  virtual double stiffness() const = 0;                                  // N/m of the Cartesian impedance that it needs
};

// Hybrid control of position and force (Raibert, Craig 1981, doi:10.1115/1.3139652), as an admittance around the
// impedance of the arm: across the direction the tool keeps to its trajectory; along it the reference is shifted by
// what the force lacks, by 3 cm to where it presses and 2 cm back at most. It presses first and sets out when it does;
// with nothing to press on for two seconds it sets out all the same, and gives up at the end. Options: press,
// press_along.
std::unique_ptr<Steering> make_pressing(Trajectory trajectory, const FollowOptions& options);

// Straight on as long as the arm follows: the reference is never further ahead than what `search_force` takes. Where it
// stands still, the tool goes round an Archimedean spiral across its way (Chhatpar, Branicky 2001,
// doi:10.1109/IROS.2001.976415) while it presses on with that force, until it gets on by more than a millimetre, then
// straight on from there. Options: search, search_pitch, search_force.
std::unique_ptr<Steering> make_searching(Trajectory trajectory, const FollowOptions& options);

// The configuration next to `q` at which the tip is shifted by a small `offset`, its direction as it is.
JointVector shifted(const Arm& arm, const JointVector& q, const Vector3& offset);

}  // namespace stampede
