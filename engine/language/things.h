// What can be spoken of in a scene, and what each thing is in a goal and a plan.
#pragma once

#include "engine/language/meaning.h"
#include "engine/model/scene.h"

namespace stampede {

// The things of a start; their words go into the meaning's lexicon. What `others`, further starts of the variation,
// have otherwise is said of none.
void read_things(const Domain& domain, const Scene& scene, const std::vector<Scene>& others, Meaning& meaning);

// What other starts call otherwise is called alike, in `facts` too.
void name_alike(const std::vector<Scene>& others, Meaning& meaning);

// What is to be done, from a state with these facts; what a plan does because of `assumed`, which nobody can see, is
// not said.
struct Deed {
  const Facts& facts;
  const Facts& assumed;
  const Formula& goal;
};
// Of the goal and of meaning.steps, whose skills must be there.
void read_roles(const Deed& deed, Meaning& meaning);

}  // namespace stampede
