#include <fmt/format.h>

#include <ostream>

#include "engine/base/text.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/lock_check.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

constexpr std::size_t kMostLines = 10;  // of strands, for people

// `stack_blocks colour=red: seeds 0, 12 … 96, 9 episodes`
std::string line_of(const SeedStrand& strand) {
  const std::string name = strand.task + (strand.variation.empty() ? "" : " " + strand.variation);
  if (strand.count == 1) return fmt::format("{}: seed {}", name, strand.first_seed);
  const std::int64_t last = strand.first_seed + (strand.count - 1) * strand.stride;
  return fmt::format("{}: seeds {}, {} … {}, {} episodes", name, strand.first_seed, strand.first_seed + strand.stride,
                     last, strand.count);
}

std::int64_t episodes_of(const std::vector<SeedStrand>& strands) {
  std::int64_t count = 0;
  for (const SeedStrand& strand : strands) count += strand.count;
  return count;
}

void tell(const std::vector<SeedStrand>& strands, const std::string& what, Console& console) {
  if (strands.empty()) return;
  console.out << fmt::format("{} episodes {}:\n", episodes_of(strands), what);
  for (std::size_t i = 0; i < std::min(strands.size(), kMostLines); ++i)
    console.out << "    " << line_of(strands[i]) << "\n";
  if (strands.size() > kMostLines) console.out << fmt::format("    and {} more\n", strands.size() - kMostLines);
}

void add_json(const char* name, const std::vector<SeedStrand>& strands, JsonText& text) {
  text.key(name).array();
  for (const SeedStrand& one : strands) {
    text.object().field("task", one.task).field("variation", one.variation).field("first_seed", one.first_seed);
    text.field("stride", one.stride).field("count", one.count).end();
  }
  text.end();
}

ExitCode do_verify(const Arguments& arguments, Console& console) {
  const Lock lock = lock_from_file(arguments.text("LOCK"));
  std::vector<Catalogue> catalogues;
  for (const std::string& file : arguments.list("FILE")) catalogues.push_back(Catalogue::open(file));
  std::vector<const Catalogue*> all;
  for (const Catalogue& one : catalogues) all.push_back(&one);
  return tell_check(verify(lock, all), lock, arguments.flag("--json"), console);
}

}  // namespace

ExitCode tell_check(const LockCheck& check, const Lock& lock, bool json, Console& console) {
  if (json) {
    JsonText text;
    text.object().field("as_locked", check.whole).field("episodes", lock.episodes()).field("same", check.same);
    add_json("missing", check.missing, text);
    add_json("different", check.other, text);
    add_json("further", check.further, text);
    text.key("scripts").array();
    for (const std::string& path : check.other_scripts) text.value(path);
    console.out << text.end().end().text();
    return check.whole ? kDone : kNo;
  }
  if (check.whole) {
    console.out << (lock.is_plan()
                        ? fmt::format("complete: {} episodes\n", lock.episodes())
                        : fmt::format("as locked: {} episodes, content hash {}\n", lock.episodes(), lock.hash));
    return kDone;
  }
  console.out << (lock.is_plan()
                      ? fmt::format("incomplete: {} of {} episodes are there\n", check.same, lock.episodes())
                      : fmt::format("not as locked: {} of {} episodes are the same\n", check.same, lock.episodes()));
  tell(check.missing, "are missing", console);
  tell(check.other, "have other content", console);
  tell(check.further, "were not locked", console);
  if (!check.other_scripts.empty())
    console.out << "other scripts than were locked: " << joined(check.other_scripts) << "\n";
  return kNo;
}

CommandRow verify_command() {
  return {"verify",
          "Compare a catalogue with a lock",
          "Every value of every episode counts, wall times left out; of a plan only what is missing does. Several "
          "files are parts of one. Says which episodes are missing, have other content or were not locked, and which "
          "scripts differ; the exit code is 0 where the catalogue holds exactly what was locked.",
          {{"LOCK", "what `stampede lock` or `run --plan` wrote", true, false},
           {"FILE", "the catalogue, or its parts", true, true}},
          {},
          {"stampede verify buttons.lock again.db", "stampede verify buttons.plan part1.db part2.db"},
          do_verify};
}

}  // namespace stampede::program
