#include "db/merge.h"

#include <fmt/format.h>

#include <ostream>

#include "engine/base/text.h"
#include "scripting/commands/commands.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

void print_json(const std::string& out, const MergeResult& result, Console& console) {
  JsonText text;
  text.object().field("out", out).field("interrupted", result.interrupted).key("files").array();
  for (const MergedFile& file : result.files)
    text.object().field("file", file.path).field("added", file.added).field("existing", file.existing).end();
  console.out << text.end().end().text();
}

ExitCode do_merge(const Arguments& arguments, Console& console) {
  const std::string out = arguments.text("OUT");
  std::vector<std::filesystem::path> from;
  for (const std::string& path : arguments.list("IN")) from.emplace_back(path);
  const MergeResult result = merge(out, from, {arguments.flag("--mixed"), console.stop});
  if (arguments.flag("--json")) {
    print_json(out, result, console);
  } else {
    for (const MergedFile& file : result.files) {
      console.out << fmt::format("{}: {} episodes added", file.path, file.added);
      if (file.existing > 0) console.out << fmt::format(", {} were there already", file.existing);
      console.out << "\n";
    }
  }
  for (const MergedFile& file : result.files)
    if (!file.own_tables.empty())
      console.err << fmt::format("{}: tables of your own stay where they are: {}\n", file.path,
                                 joined(file.own_tables));
  if (result.interrupted) console.err << "interrupted: the same command goes on from there\n";
  return result.interrupted ? kInterrupted : kDone;
}

}  // namespace

CommandRow merge_command() {
  return {
      "merge",
      "Put the episodes of many catalogues into one",
      "By key: an episode that is there already is not added again, and two that have the same key and other "
      "content are an error that names both files, before anything is written; so are files of which two versions of a "
      "script, two releases or two classes of processor made the episodes, without --mixed. Catalogues of earlier "
      "releases are migrated in a temporary copy. The content hash of OUT is that of one run that made all the "
      "episodes.",
      {{"OUT", "the catalogue to write; made when it is not there", true, false},
       {"IN", "catalogues to read", true, true}},
      {{"--mixed", "", "also episodes that were made differently", Takes::flag, "", {}, false}},
      {"stampede merge demos.db part1.db part2.db", "stampede merge now.db old.db"},
      do_merge};
}

}  // namespace stampede::program
