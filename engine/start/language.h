// Sentences by template: what things are called, what holds, what a skill does.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/model/scene.h"
#include "engine/symbolic/symbols.h"

namespace stampede {

// `red cube`, `top drawer of the chest`; where others share the words, with its place among them in the first
// picture: `left red cube`, `second red cube from the left`, `upper money`.
std::string phrase(const Scene& scene, const std::string& object);

// The same; nothing where things that share the words do not stand clearly apart in the picture: one on the other, or
// side by side along the view.
std::optional<std::string> clear_phrase(const Scene& scene, const std::string& object);

// Fills {name} from the binding, as phrases for objects and as they are otherwise; `the {obj}` reads well.
std::string fill(const std::string& text, const std::vector<Parameter>& parameters,
                 const std::vector<std::string>& arguments, const Scene& scene);

// Of what is known of what holds: without facts on things of which something is not known that holds. Of a tin in a
// shut drawer nothing is said, not even that it is on the drawer's floor.
Facts mentionable(const Facts& holds, const Facts& known, const Domain& domain, const Scene& scene);

// One sentence a fact that a person would mention: basic and derived facts with a label; nothing on where a region or a
// part of a thing is seen from that thing, nor of what follows from that.
std::vector<std::string> describe_world(const Facts& facts, const Domain& domain, const Scene& scene);

}  // namespace stampede
