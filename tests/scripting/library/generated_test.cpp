// What is made from the field tables, and the templates.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "scripting/library/annotations.h"
#include "scripting/library/fields.h"
#include "scripting/library/library.h"
#include "scripting/library/source_lines.h"

using namespace stampede;
namespace fs = std::filesystem;

namespace {

std::string file_text(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("the editor's files are what field tables and Lua files say (run stampede doc)") {
  const fs::path folder = STAMPEDE_SOURCE_DIR "/scripting/library";
  CHECK(file_text(folder / "stampede.lua") == field_annotations());
  CHECK(file_text(folder / "names.lua") == name_annotations(*Library::load({{STAMPEDE_SOURCE_DIR}})));
}

TEST_CASE("each field has a type that something has, and a sentence") {
  for (const Record& one : records()) {
    for (const Field& field : one.fields) {
      INFO(one.name << "." << field.name);
      CHECK(std::string_view(field.type).size() > 0);
      CHECK((std::string_view(field.description).size() > 0 || std::string_view(field.unit).size() > 0 ||
             field.required));
    }
  }
}

TEST_CASE("new files pass the check beside ours") {
  std::string name = (fs::temp_directory_path() / "stampede_new_file_XXXXXX").string();
  REQUIRE(mkdtemp(name.data()) != nullptr);
  const fs::path root = name;
  const std::pair<DefinitionKind, const char*> kinds[] = {{DefinitionKind::task, "tasks"},
                                                          {DefinitionKind::skill, "skills"},
                                                          {DefinitionKind::predicate, "worlds/predicates"},
                                                          {DefinitionKind::object, "worlds/objects"},
                                                          {DefinitionKind::world, "worlds"}};
  for (const auto& [kind, folder] : kinds) {
    fs::create_directories(root / folder);
    std::ofstream(root / folder / "my_new_one.lua") << new_file(kind, "my_new_one");
  }
  std::vector<Error> complaints;
  Library::check({{STAMPEDE_SOURCE_DIR, root}}, complaints);
  for (const Error& complaint : complaints) UNSCOPED_INFO(complaint.what());
  CHECK(complaints.empty());
  fs::remove_all(root);
  CHECK_THROWS_WITH(new_file(DefinitionKind::task, "end"), Catch::Contains("reserved") && Catch::Contains("end_it"));
}

TEST_CASE("lines of fields are those of the source") {
  const auto lines = field_lines(
      "-- a\n-- b = {\nreturn task {\n  a = { x = 1,\n    y = 2 },\n  b = function(v)\n    return { z = v.a == 1 }\n  "
      "end,\n"
      "  c = [[\n d = 1 ]],\n  e = \"f = 2\",\n}\n");
  const std::map<std::string, int> expected = {{"", 3},  {"a", 4},   {"a.x", 4}, {"a.y", 5},
                                               {"b", 6}, {"b.z", 7}, {"c", 9},   {"e", 11}};
  CHECK(lines == expected);
  CHECK(line_of(lines, "a.y.deep") == 5);
  CHECK(line_of(lines, "missing") == 3);
}

TEST_CASE("every type that a field names is one that there is") {
  const std::set<std::string> plain = {"string",  "number", "integer", "boolean", "function", "vector",
                                       "range",   "size",   "numbers", "colour",  "on_table", "literal",
                                       "formula", "effect", "call",    "cover",   "table",    "any"};
  for (const Record& one : records())
    for (const Field& field : one.fields) {
      std::string_view types = field.type;
      while (!types.empty()) {
        std::string_view type = types.substr(0, types.find('|'));
        types.remove_prefix(std::min(type.size() + 1, types.size()));
        while (type.ends_with("[]")) type.remove_suffix(2);
        if (type.starts_with('{')) type = type.substr(1, type.size() - 2);
        INFO(one.name << "." << field.name << ": " << type);
        CHECK((plain.contains(std::string(type)) || record(type) != nullptr));
      }
    }
}
