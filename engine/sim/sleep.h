// What has come to rest sleeps: it keeps its contacts and their impulses, and costs nothing. What meets a sleeper wakes
// all that lies together with it. Private to engine/sim.
#pragma once

#include <vector>

#include "engine/sim/islands.h"

namespace stampede {

class Sleep {
 public:
  Sleep(btCollisionWorld& world, Movers& movers, double dt) : world_(world), movers_(movers), dt_(dt) {}
  void wake(const btCollisionObject& object);  // and all that lies together with it
  void wake_what_is_met();
  void wake_all();  // who slept may sleep again as soon as contacts are found anew
  // Whole islands at once. What hangs in the air has none.
  void fall_asleep(const std::vector<Island>& islands);

 private:
  bool meet(const btPersistentManifold& manifold) const;
  void rouse(int mover);
  void wake_with_neighbours(int mover);
  void rouse_neighbours(int woken, const MoverLink& one, const MoverLink& other);

  btCollisionWorld& world_;
  Movers& movers_;
  double dt_;
  std::vector<int> waking_, least_rest_;
};

}  // namespace stampede
