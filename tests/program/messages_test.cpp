// What is told to people: no address of this process, and nothing that a terminal would obey.
#include <catch2/catch.hpp>

#include "db/catalogue.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

std::string task_after(const std::string& line) {
  return "-- A task.\n" + line +
         "\nreturn task { world = \"tabletop\", objects = { b = { \"cube\" } }, init = { is.on(\"b\", \"table\") }, "
         "goal = is.holding(\"b\"), instructions = { \"x\" } }\n";
}

// As Lua and C write them.
bool holds_address(const std::string& text) { return says(text, "0x"); }

bool holds_orders(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7F;
  });
}

}  // namespace

TEST_CASE("messages of scripts hold no addresses, whatever the value is that they speak of") {
  const Folder mine;
  std::vector<std::string> names;
  for (const char* value : {"{}", "print", "function() end", "is", "coroutine", "setmetatable({}, { __name = 'x' })"})
    for (const char* form : {"string[V] = 1", "local x = is[V]", "_G[V] = 1", "error(V)", "error(tostring(V))",
                             "error(string.format('%s', V))", "error('' .. V)", "local x = V < V", "local x = #V.y.z",
                             "colours[V] = 1", "local x = colours[V]", "local x = worlds[V]", "deg(V)", "box { V }",
                             "is.on(V, V)", "one_of(V)", "between(V, V)", "assert(false, V)"}) {
      std::string line = form;
      for (std::size_t at = line.find('V'); at != std::string::npos; at = line.find('V', at + 1))
        if (at + 1 == line.size() || !std::isalpha(static_cast<unsigned char>(line[at + 1])))
          line.replace(at, 1, value), at += std::string(value).size() - 1;
      names.push_back("t" + std::to_string(names.size()));
      put(mine, "tasks/" + names.back() + ".lua", task_after(line));
    }
  const Said said = checked(mine, names);
  INFO(said.out << said.err);
  CHECK_FALSE(holds_address(said.out + said.err));
  CHECK(said.code == kBadInput);
  const auto refused = static_cast<double>(std::count_if(
      names.begin(), names.end(), [&](const std::string& name) { return says(said.out, "tasks/" + name + ".lua:"); }));
  CHECK(refused > 0.8 * static_cast<double>(names.size()));  // the rest only reads what is not there
}

TEST_CASE("a message shows what a terminal would obey as an escape, in every command and on both streams") {
  const std::string evil = "\\27[2J\\27]0;gone\\7\\r\\155\\u{202e}\\xff";
  const Folder mine;
  put(mine, "tasks/t.lua", task_after("error(\"" + evil + "\")"));
  const Said said = checked(mine, {"t"});
  INFO(said.out << said.err);
  CHECK(said.code == kBadInput);
  CHECK(says(said.out + said.err, "\\x1b[2J\\x1b]0;gone\\x07\\r\\x9b\\u202e\\xff"));
  CHECK_FALSE(holds_orders(said.out + said.err));
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"\x1b[2J"},
           {"run", "\x1b[2J", "--root", kRoot, "--out", "no.db"},
           {"list", "\x1b[2J", "--root", kRoot},
           {"query", "\x1b[2J.db", "SELECT 1"},
           {"check", "\x1b[2J", "--root", kRoot},
           {"plan", "\x1b[2J.pddl", "\x9b.pddl", "--root", kRoot},
           {"run", "reach_target", "--root", kRoot, "--out", "/nowhere/\x1b[2J.db"}}) {
    const Said one = say(words);
    INFO(one.out << one.err);
    CHECK(one.code != kDone);
    CHECK(says(one.err, "\\x1b[2J"));
    CHECK_FALSE(holds_orders(one.out + one.err));
  }
}

TEST_CASE("tables for people are printable, JSON and CSV stay exact") {
  const Folder folder;
  const std::string db = folder / "d.db";
  REQUIRE(say({"run", "reach_target", "--root", kRoot, "--out", db}).code == kDone);
  const std::string question = "SELECT 'a' || char(27) || '[2J' || char(0x202e) || char(10) || 'b' AS \"x\x1by\"";
  const Said table = say({"query", db, question}), csv = say({"query", db, question, "--format", "csv"}),
             json = say({"query", db, question, "--json"});
  CHECK(says(table.out, "a\\x1b[2J\\u202e\\nb"));
  CHECK(says(table.out, "x\\x1by"));
  CHECK_FALSE(holds_orders(table.out));
  CHECK(csv.out == "x\x1by\n\"a\x1b[2J\u202e\nb\"\n");
  CHECK(says(json.out, "a\\u001b[2J\u202e\\nb"));
}

}  // namespace stampede::program
