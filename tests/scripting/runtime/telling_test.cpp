// Of every task that ships, under every sort of drawn looks: what names, facts and sentences speak of looks as they
// say, different things look different, and lamps and screens show whether they are on.
#include "engine/model/telling.h"

#include <catch2/catch.hpp>
#include <cctype>
#include <set>

#include "engine/model/randomise.h"
#include "engine/start/perturbation.h"
#include "scripting/runtime/episode_scripts.h"

using namespace stampede;

namespace {

constexpr double kSeen = 20;  // of CIE 1976: nobody overlooks it

const std::map<std::string, Colour>& colours() {
  static const std::map<std::string, Colour> known{{"red", {0.85, 0.10, 0.10}},
                                                   {"green", {0.10, 0.55, 0.15}},
                                                   {"blue", {0.10, 0.20, 0.85}},
                                                   {"yellow", {0.95, 0.90, 0.10}},
                                                   {"orange", {0.98, 0.50, 0.05}}};
  return known;
}

std::set<std::string> words(const std::vector<std::string>& sentences) {
  std::set<std::string> found;
  for (const std::string& sentence : sentences) {
    std::string word;
    for (const char c : sentence + " ")
      if (std::isalpha(static_cast<unsigned char>(c)) != 0)
        word += static_cast<char>(std::tolower(c));
      else
        found.insert(std::exchange(word, ""));
  }
  return found;
}

std::vector<Colour> seen(const Scene& scene, const Shape& shape) {
  const auto texture = scene.textures.find(shape.texture);
  if (texture == scene.textures.end()) return {shape.colour};
  return {texture->second.first, texture->second.second};
}

double least_difference(const std::vector<Colour>& first, const std::vector<Colour>& second) {
  double least = 1e9;
  for (const Colour& a : first)
    for (const Colour& b : second) least = std::min(least, difference(a, b));
  return least;
}

bool same_look(const Shape& a, const Shape& b) {
  return a.texture == b.texture && a.colour.red == b.colour.red && a.colour.green == b.colour.green &&
         a.colour.blue == b.colour.blue;
}

bool looks_so(const Scene& scene, const Colour& colour) {
  for (const Body& body : scene.bodies)
    for (const Part& part : body.parts)
      for (const Shape& shape : part.shapes)
        if (shape.visible && least_difference(seen(scene, shape), {colour}) < kSeen * 1.5) return true;
  return std::any_of(scene.regions.begin(), scene.regions.end(), [&](const Region& region) {
    return region.visible && difference(region.colour, colour) < kSeen * 1.5;
  });
}

const Body& body_of(const Scene& scene, const Object& object) { return scene.body_at(scene.body_index(object.body)); }

// A shape that shows a fact is as it was, and is seen on its part.
void check_states(const Scene& before, const Scene& after) {
  for (std::size_t b = 0; b < after.bodies.size(); ++b)
    for (std::size_t p = 0; p < after.bodies[b].parts.size(); ++p) {
      const std::vector<Shape>&was = before.bodies[b].parts[p].shapes, &is = after.bodies[b].parts[p].shapes;
      for (std::size_t i = 0; i < is.size(); ++i)
        if (!is[i].shown_by.empty()) {
          INFO(after.bodies[b].name);
          CHECK(same_look(was[i], is[i]));
        }
    }
}

// Things that facts tell something of look as before; of two whose looks differed the looks still do.
void check_things(const Scene& before, const Scene& after) {
  for (const Object& object : before.objects) {
    if (object.kind != ObjectKind::body || before.body_index(object.body) < 0) continue;
    const Body &was = body_of(before, object), &is = body_of(after, object);
    INFO(object.name);
    const bool told = object.attributes.contains("colour") || object.attributes.contains("digit");
    for (std::size_t p = 0; told && p < is.parts.size(); ++p)
      for (std::size_t i = 0; i < is.parts[p].shapes.size(); ++i)
        CHECK(same_look(was.parts[p].shapes[i], is.parts[p].shapes[i]));
    for (const Object& other : before.objects) {
      if (other.kind != ObjectKind::body || other.type != object.type || before.body_index(other.body) < 0) continue;
      const Body& beside = body_of(before, other);
      if (!beside.free || !was.free || beside.parts[0].shapes.empty() || was.parts[0].shapes.empty()) continue;
      const double differed =
          least_difference(seen(before, was.parts[0].shapes[0]), seen(before, beside.parts[0].shapes[0]));
      const double differs =
          least_difference(seen(after, is.parts[0].shapes[0]), seen(after, body_of(after, other).parts[0].shapes[0]));
      INFO(other.name);
      if (differed > kSeen) CHECK(differs > kSeen);
    }
  }
}

// Marks: of shapes of one part that could be told apart, and were small on a wide one, none is lost.
void check_marks(const Scene& before, const Scene& after) {
  for (std::size_t b = 0; b < after.bodies.size(); ++b)
    for (std::size_t p = 0; p < after.bodies[b].parts.size(); ++p) {
      const std::vector<Shape>&was = before.bodies[b].parts[p].shapes, &is = after.bodies[b].parts[p].shapes;
      for (std::size_t i = 0; i < is.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
          if (!is[i].visible || !is[k].visible || same_look(was[i], was[k])) continue;
          INFO(after.bodies[b].name << "." << after.bodies[b].parts[p].name << " " << k << " " << i);
          if (least_difference(seen(before, was[i]), seen(before, was[k])) > kSeen)
            CHECK(least_difference(seen(after, is[i]), seen(after, is[k])) > kSeen);
        }
    }
}

}  // namespace

TEST_CASE("drawn looks contradict no sentence, fact or name, and hide no state, in every task that ships") {
  const auto library = Library::load(Roots{{STAMPEDE_SOURCE_DIR}});
  int states = 0, spoken = 0, drawn = 0;
  for (const ScriptFile* file : library->files(DefinitionKind::task)) {
    const auto& variations = library->task(file->name)->variation_texts;
    for (std::size_t i = 0; i < variations.size(); i += variations.size() / 3 + 1) {
      EpisodeScripts scripts(library, file->name, variations[i], 1);
      const Task task = scripts.task()(0);
      for (const char* how : {"randomise", "texture=1", "texture=4"}) {
        Scene after = task.scene;
        const RandomKey key = RandomKey("telling").with(static_cast<int>(i));
        if (how == std::string("randomise"))
          randomise(after, default_randomisation(), key, task.instructions);
        else
          perturb(after, perturbation_from(how, ""), key, task.instructions);
        INFO(file->name << " " << variations[i] << ", " << how);
        check_states(task.scene, after);
        check_things(task.scene, after);
        check_marks(task.scene, after);
        for (const std::string& word : words(task.instructions))
          if (const auto colour = colours().find(word);
              colour != colours().end() && looks_so(task.scene, colour->second)) {
            INFO(word);
            CHECK(looks_so(after, colour->second));
            ++spoken;
          }
        for (std::size_t b = 0; b < after.bodies.size(); ++b)
          for (std::size_t p = 0; p < after.bodies[b].parts.size(); ++p)
            for (std::size_t s = 0; s < after.bodies[b].parts[p].shapes.size(); ++s) {
              states += after.bodies[b].parts[p].shapes[s].shown_by.empty() ? 0 : 1;
              drawn += same_look(after.bodies[b].parts[p].shapes[s], task.scene.bodies[b].parts[p].shapes[s]) ? 0 : 1;
            }
      }
    }
  }
  CHECK(states > 10);
  CHECK(spoken > 60);
  CHECK(drawn > 1000);
}
