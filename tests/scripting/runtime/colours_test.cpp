// How different colours look, and that no shipped task shows two that a person takes for one another.
#include <catch2/catch.hpp>
#include <lua.hpp>

#include "scripting/library/definitions.h"
#include "scripting/library/lua_value.h"
#include "scripting/runtime/episode_scripts.h"

using namespace stampede;

namespace {

constexpr double kConfused = 32;  // as prelude.lua says

std::shared_ptr<const Library> library() {
  static const auto shared = Library::load(Roots{{STAMPEDE_SOURCE_DIR}});
  return shared;
}

Value answer(const std::string& expression) {
  DefinitionState state(library());
  state.sandbox().run(Sandbox::compile("return " + expression, "test"), "@test", 1);
  return value_as_written(state.state(), -1, "test");
}

double difference(const std::string& a, const std::string& b) {
  return answer("colours.difference('" + a + "', '" + b + "')").number;
}

}  // namespace

TEST_CASE("the difference of colours is CIEDE2000") {  // the values by another implementation, which has Sharma's pairs
  CHECK(difference("red", "red") == 0);
  CHECK(difference("red", "maroon") == Approx(21.083).margin(0.001));
  CHECK(difference("silver", "white") == Approx(11.469).margin(0.001));
  CHECK(difference("azure", "cyan") == Approx(31.825).margin(0.001));
  CHECK(difference("black", "navy") == Approx(25.865).margin(0.001));
  CHECK(difference("navy", "black") == Approx(difference("black", "navy")));
}

TEST_CASE("other colours are those that nobody takes for the one") {
  const Value others = answer("colours.except('azure')");
  CHECK(others.items.size() >= 9);
  for (const Value& other : others.items) CHECK(difference("azure", other.text) >= kConfused);
  CHECK(answer("colours.except('azure', 'red')").items.size() < others.items.size());
  CHECK(answer("colours.except()").items.size() == answer("colours.names").items.size());
}

TEST_CASE("no shipped task shows a colour that a person takes for the one it asks for") {
  std::map<std::pair<std::string, std::string>, double> known;
  for (const ScriptFile* file : library()->files(DefinitionKind::task)) {
    const auto& variations = library()->task(file->name)->variation_texts;
    for (std::size_t i = 0; i < variations.size(); i += variations.size() / 5 + 1) {
      EpisodeScripts scripts(library(), file->name, variations[i], 1);
      std::map<std::string, std::set<std::string>> shown;  // by what it is: a green zone is no green block
      const Task task = scripts.task()(0);
      std::set<std::string> asked;
      for (const auto& [axis, value] : task.axes) asked.insert(value);
      for (const Object& object : task.scene.objects)
        if (const auto colour = object.attributes.find("colour"); colour != object.attributes.end())
          shown[object.class_name].insert(colour->second);
      for (const auto& [what, colours] : shown)
        for (auto a = colours.begin(); a != colours.end(); ++a)
          for (auto b = std::next(a); b != colours.end(); ++b) {
            if (!asked.contains(*a) && !asked.contains(*b)) continue;
            const auto [found, fresh] = known.try_emplace({*a, *b}, 0);
            if (fresh) found->second = difference(*a, *b);
            INFO(file->name << " " << variations[i] << ", " << what << ": " << *a << " and " << *b);
            CHECK(found->second >= kConfused);
          }
    }
  }
  CHECK(known.size() > 10);
}
