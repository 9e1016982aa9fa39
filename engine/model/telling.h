// Which looks of a scene tell something, so that drawing others would contradict what is said of it: of things whose
// name, attributes or sentences speak of how they look, of things that only their looks tell apart, of marks on a part,
// and of shapes that show a fact. Everything else may look otherwise.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/random.h"
#include "engine/model/randomise.h"
#include "engine/model/scene.h"

namespace stampede {

class Telling {
 public:
  // Lifetime: no longer than the scene.
  Telling(const Scene& scene, const std::vector<std::string>& said);

  // Its look tells as a whole.
  bool tells(const Body& body, std::size_t part) const;

  // What of a part may look otherwise: the ground that its marks are on. Indices of its shapes; of a robot, which has
  // no marks, all. None where the part tells.
  std::vector<std::size_t> ground(const Body& body, std::size_t part) const;

  // The colours that what is drawn for a part of this body must stand out from.
  std::vector<Colour> standing(const Body& body) const;

 private:
  void keep(const Object& object);
  void keep_named();
  void keep_twins();
  void keep_spoken(const std::string& sentence);
  bool keep_followed(const std::vector<std::string>& words, std::size_t look);

  const Scene& scene_;
  std::set<std::pair<std::string, int>> kept_;  // bodies and their parts; -1: all of them
};

// How differently two colours look: CIE 1976, about 2 is the least that anybody sees, 100 black beside white.
double difference(const Colour& first, const Colour& second);

}  // namespace stampede
