// What is said of the starts of every task that ships, and what its things are called.
#include <algorithm>
#include <catch2/catch.hpp>
#include <regex>

#include "engine/episode/runner.h"
#include "engine/sim/world.h"
#include "engine/start/fact_tracker.h"
#include "engine/start/language.h"
#include "scripting/runtime/episode_scripts.h"
#include "tests/support/make_start.h"

using namespace stampede;

namespace {

bool has_code(const std::string& text) {  // squares of a chess board are called by theirs
  static const std::regex square("square [a-h][1-8]");
  const std::string rest = std::regex_replace(text, square, "");
  return rest.find('_') != std::string::npos || rest.find_first_of("0123456789.") != std::string::npos;
}

bool says_twice(const std::string& text) {  // the peg of the square peg
  static const std::regex twice("\\b(\\w+) of the (\\w+ )*\\1$");
  return std::regex_search(text, twice);
}

// What holds at the start of things that nobody sees there or was told of.
std::set<std::string> hidden(const Facts& holds, const Facts& known, const Scene& scene) {
  std::set<std::string> names;
  for (const Fact& fact : holds) {
    const Object* thing = fact.arguments.empty() ? nullptr : scene.object(fact.arguments[0]);
    const int body = thing == nullptr || thing->kind != ObjectKind::body ? -1 : scene.body_index(thing->body);
    if (fact.predicate == "inside" && body >= 0 && !known.contains(fact)) names.insert(thing->name);
  }
  return names;
}

}  // namespace

TEST_CASE("of every task's starts: no code in a name, no hidden thing, nothing about a thing's own parts") {
  const auto library = Library::load(Roots{{STAMPEDE_SOURCE_DIR}});
  int sentences = 0, concealed = 0;
  for (const ScriptFile* file : library->files(DefinitionKind::task)) {
    const auto& variations = library->task(file->name)->variation_texts;
    EpisodeScripts scripts(library, file->name, variations.back(), 3);
    RunOptions options;
    options.seed = 3;
    const Start start = make_start(scripts.task(), scripts.symbols(), options);
    INFO(file->name << ": " << start.detail);
    REQUIRE(start.scene);
    const Scene& scene = *start.scene;
    for (const Object& object : scene.objects) {
      INFO(object.name << ": " << phrase(scene, object.name));
      CHECK_FALSE(has_code(phrase(scene, object.name)));
      CHECK_FALSE(says_twice(phrase(scene, object.name)));
    }
    World world(start.scene);
    WorldView view(world);
    FactTracker tracker(scripts.symbols(), view);
    tracker.begin(tracker.read_all(view));
    tracker.look(view);
    tracker.tell(scripts.task()(0).told);
    const Domain& domain = scripts.symbols().domain();
    const std::set<std::string> unseen = hidden(tracker.facts(), tracker.observed(), scene);
    concealed += static_cast<int>(unseen.size());
    for (const std::string& text :
         describe_world(mentionable(tracker.facts(), tracker.observed(), domain, scene), domain, scene)) {
      INFO(text);
      ++sentences;
      CHECK_FALSE(has_code(text));
      for (const char* own : {" behind the ", " under the ", "before or above"})
        CHECK(text.find(own) == std::string::npos);
      for (const std::string& name : unseen) CHECK(text.find("the " + phrase(scene, name)) == std::string::npos);
    }
  }
  CHECK(sentences > 200);
  CHECK(concealed > 0);
}
