// What rests on what.
#pragma once

#include <vector>

#include "engine/model/part_ref.h"
#include "engine/model/scene.h"

namespace stampede {

// A free body and what bears it.
struct Borne {
  PartRef bearer;
  int body = 0;
};

class World;

// What rests on what, in the last window: of each free body that the hand does not hold what bears most of it, a
// quarter of its weight at least. Contents are load: they go with what bears them.
std::vector<Borne> loads(const World& world);

// The bodies that go with a part and all that hangs on it, of a base part with the whole body: those that it bears, and
// those that they bear.
std::vector<int> borne_by(const Scene& scene, const std::vector<Borne>& loads, PartRef part);

}  // namespace stampede
