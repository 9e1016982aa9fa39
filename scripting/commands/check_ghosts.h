// Ghosts in a picture of what was turned down: which ones, in what colours, and the scene around them.
#pragma once

#include <string>
#include <vector>

#include "engine/start/impasse.h"

namespace stampede::program {

struct LegendLine {
  Colour colour;
  int count = 0;
  std::string text;
};
// One line a cause, the most frequent first: red ones touch something, another shade for each of the first three.
std::vector<LegendLine> legend_of(const std::vector<Looked>& looked);

struct Ghost {
  const Looked* looked = nullptr;
  Colour colour;
};
// Nearest misses first, of each cause in turn; what is nearly where another one is tells nothing.
std::vector<Ghost> chosen_ghosts(const std::vector<Looked>& looked, const std::vector<LegendLine>& legend, bool hands);
// What a ghost looks like: parts of the robot from the tip's part on, or the object's body.
Body ghost_of(const Scene& scene, const Impasse& impasse, const Looked& looked, const std::string& name,
              const Colour& colour);

// Regions that the step names can be seen: what is put somewhere is put into them.
void show_regions(const std::string& step, Scene& scene);
// Pale, but for the thing itself: what stands out are the ghosts.
void fade(Scene& scene, const std::string& subject);

}  // namespace stampede::program
