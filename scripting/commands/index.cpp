#include <fmt/format.h>

#include <ostream>

#include "db/lake.h"
#include "engine/base/text.h"
#include "scripting/commands/commands.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

ExitCode do_index(const Arguments& arguments, Console& console) {
  const LakeChange change = Lake::index(arguments.text("DIR"), console.stop);
  if (!change.left_out.empty()) console.err << fmt::format("no catalogues, left out: {}\n", joined(change.left_out));
  if (arguments.flag("--json")) {
    JsonText json;
    json.object().field("files", change.files).field("episodes", change.episodes).field("added", change.added);
    console.out << json.field("removed", change.removed).field("twice", change.twice).end().text();
  } else {
    console.out << fmt::format("{} catalogues, {} episodes; {} files were new, {} are gone or have changed",
                               change.files, change.episodes, change.added, change.removed);
    if (change.twice > 0) console.out << fmt::format("; {} episodes are in two files and count once", change.twice);
    console.out << "\n";
  }
  if (change.interrupted) console.err << "interrupted: the same command goes on from there\n";
  return change.interrupted ? kInterrupted : kDone;
}

}  // namespace

CommandRow index_command() {
  return {
      "index",
      "Make a folder of catalogues one that `query` can ask, however many they are",
      "Every catalogue (*.db) below DIR is one of it. The index, DIR/index.lake, holds what questions ask, but what "
      "there is for every frame (joints, poses, sensors, pictures): that stays in the files and is read there when a "
      "question wants it. The same command again looks only at files that are new, gone or changed. An answer is that "
      "of the merged file: an episode that two files have counts once, other content under one key is an error.",
      {{"DIR", "the folder", true, false}},
      {},
      {"stampede index shards"},
      do_index};
}

}  // namespace stampede::program
