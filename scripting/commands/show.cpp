#include <fmt/format.h>

#include <charconv>
#include <ostream>
#include <set>

#include "db/catalogue.h"
#include "scripting/commands/commands.h"
#include "scripting/program/timeline.h"

namespace stampede::program {

std::int64_t episode_number(const std::string& text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw UsageError("an episode is a number, not '" + text + "'",
                     "stampede query FILE \"SELECT episode FROM episodes\"");
  }
  return number;
}

namespace {

// `, 208 pictures of 2 cameras, 494 kB`; nothing when there are none.
std::string pictures_text(const std::vector<ImageEntry>& images) {
  if (images.empty()) return {};
  std::set<std::string> cameras;
  std::int64_t bytes = 0;
  for (const ImageEntry& image : images) {
    cameras.insert(image.camera);
    bytes += image.bytes;
  }
  return fmt::format(", {} pictures of {} camera{}, {:.0f} kB", images.size(), cameras.size(),
                     cameras.size() == 1 ? "" : "s", static_cast<double>(bytes) / 1000);
}

ExitCode run(const Arguments& arguments, Console& console) {
  const std::int64_t number = episode_number(arguments.text("EPISODE"));
  const Catalogue catalogue = Catalogue::open(arguments.text("FILE"));
  const EpisodeRecord episode = catalogue.read_episode(number);
  if (arguments.flag("--json")) {
    console.out << timeline_json(episode);
    return kDone;
  }
  TimelineStyle style;
  style.width = console.width;
  style.constant_facts = arguments.flag("--all");
  style.title =
      fmt::format("episode {} of {}{}", number, arguments.text("FILE"), pictures_text(catalogue.images(number)));
  console.out << timeline(episode, style);
  return kDone;
}

}  // namespace

CommandRow show_command() {
  return {"show",
          "Show one episode as a timeline",
          "Skills and their motions as bars, with what each changed, the tries that were undone and why, the points "
          "passed without stopping, and the facts that came and went.",
          {{"FILE", "the catalogue", true, false}, {"EPISODE", "the episode's number", true, false}},
          {{"--all", "", "also the facts that held throughout", Takes::flag, "", {}, false}},
          {"stampede show demos.db 1"},
          run};
}

}  // namespace stampede::program
