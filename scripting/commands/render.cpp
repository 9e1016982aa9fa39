#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <mutex>
#include <optional>
#include <ostream>
#include <set>

#include "engine/base/ordered_work.h"
#include "engine/base/text.h"
#include "engine/base/text_file.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/picture_options.h"
#include "scripting/commands/render_overlay.h"
#include "scripting/library/library.h"
#include "scripting/program/json_text.h"

namespace stampede::program {

std::int64_t episode_number(const std::string& text);

namespace {

namespace fs = std::filesystem;

// The file that counts: later roots win. Empty when there is none.
fs::path file_in(const Roots& roots, const std::string& shown_path) {
  fs::path found;
  for (const fs::path& folder : roots.folders) {
    std::error_code error;
    if (fs::is_regular_file(folder / shown_path, error)) found = folder / shown_path;
  }
  return found;
}

// Files whose text the catalogue has otherwise than the roots (those that are in both), by their shown paths.
std::vector<std::string> changed_scripts(const EpisodeRecord& episode, const Roots& roots) {
  std::vector<std::string> changed;
  for (const DefinitionRecord& definition : episode.made.definitions) {
    const fs::path path = file_in(roots, definition.path);
    if (path.empty()) continue;
    if (!holds_text(path, definition.source)) changed.push_back(definition.path);
  }
  return changed;
}

// What --frames says: a word, or numbers and spans of numbers.
struct FrameChoice {
  std::optional<WhichFrames> which;
  std::vector<std::array<std::int64_t, 2>> spans;  // first and last
};

std::int64_t frame_number(const std::string& text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 0)
    throw UsageError("--frames takes all, keyframes, or numbers and spans of them, not '" + text + "'",
                     "--frames 0,10-20");
  return number;
}

FrameChoice frames_from(const std::string& text) {
  FrameChoice choice;
  if (text.empty()) return choice;
  choice.which = which_frames_from(text);
  if (choice.which && *choice.which != WhichFrames::none) return choice;
  for (const std::string& one : split(text, ',')) {
    const std::size_t dash = one.find('-');
    const std::int64_t first = frame_number(one.substr(0, dash));
    const std::int64_t last = dash == std::string::npos ? first : frame_number(one.substr(dash + 1));
    if (last < first) throw UsageError("--frames: " + one + " ends before it starts");
    choice.spans.push_back({first, last});
  }
  return choice;
}

// The frames of an episode; numbers that it does not have are left out: episodes differ in length.
std::vector<std::int64_t> frames_of(const FrameChoice& choice, const EpisodeRecord& episode, WhichFrames otherwise) {
  if (choice.spans.empty()) return wanted_frames(episode, choice.which.value_or(otherwise));
  std::set<std::int64_t> frames;
  const auto count = static_cast<std::int64_t>(episode.frames.size());
  for (const auto& [first, last] : choice.spans)
    for (std::int64_t frame = first; frame <= std::min(last, count - 1); ++frame) frames.insert(frame);
  return {frames.begin(), frames.end()};
}

// What was asked for and lies wholly behind the last frame; empty: nothing.
std::string lacking(const FrameChoice& choice, const EpisodeRecord& episode) {
  const auto count = static_cast<std::int64_t>(episode.frames.size());
  std::string names;
  for (const auto& [first, last] : choice.spans)
    if (first >= count) names += (names.empty() ? "" : ", ") + std::to_string(first);
  return names.empty() ? names : fmt::format("has no frame {}: its last is {}", names, count - 1);
}

// The catalogues that are read and written; they may be one.
class Shelf {
 public:
  Shelf(const fs::path& from, const fs::path& into) {
    Catalogue::open(from);  // a reader's complaints come first
    std::error_code error;
    const bool same = !into.empty() && fs::equivalent(from, into, error);
    if (!into.empty()) into_.emplace(fs::exists(into) ? Catalogue::write(into) : Catalogue::open(into));
    if (!same) from_.emplace(Catalogue::open(from));
  }
  std::vector<EpisodeSummary> episodes() const { return from().episodes(); }
  StoredEpisode read(std::int64_t id) const {
    const std::lock_guard lock(mutex_);
    return read_stored(from(), id);
  }
  AddedImages add(const Drawn& drawn) {
    const std::lock_guard lock(mutex_);
    std::optional<std::int64_t> id = drawn.stored.id;
    if (from_) id = into_->find(drawn.stored.episode.made.key);
    if (!id)
      throw Error("--into", fmt::format("the catalogue does not have episode {}", drawn.stored.id),
                  "render into the catalogue that the episode is in");
    return into_->add_images(*id, *drawn.rendered.images, drawn.rendered.cameras);
  }
  void close() {
    if (into_) into_->close();
  }

 private:
  const Catalogue& from() const { return from_ ? *from_ : *into_; }
  std::optional<Catalogue> from_, into_;
  mutable std::mutex mutex_;
};

// Exactly one of --out, --into, --video, --sheet, --overlay.
std::string place_of(const Arguments& arguments) {
  std::string place;
  for (const char* option : {"--out", "--into", "--video", "--sheet", "--overlay"}) {
    if (!arguments.has(option)) continue;
    if (!place.empty()) throw UsageError(place + " and " + option + " at once", "render twice");
    place = option;
  }
  if (place.empty())
    throw UsageError("where to?", "say --out FOLDER, --into FILE, --video FILE, --sheet FILE or --overlay FOLDER");
  for (const char* option : {"--kinds", "--noise"})
    if ((place == "--video" || place == "--sheet") && arguments.has(option))
      throw UsageError(std::string(option) + " is for --out and --into: films and sheets are for people");
  if (place == "--into" && arguments.text("--renderer") != "own")
    throw UsageError(
        "--renderer osmesa --into: pictures of a catalogue are drawn again bit for bit, and Mesa's differ by version",
        "say --out FOLDER");
  if (place == "--sheet" && arguments.has("--frames"))
    throw UsageError("--frames is not for --sheet: it shows the start, each skill and the end");
  return place;
}

class Rendering {
 public:
  Rendering(const Arguments& arguments, Console& console)
      : arguments_(arguments),
        console_(console),
        json_(arguments.flag("--json")),
        place_(place_of(arguments)),
        target_(arguments.text(place_)),
        frames_(frames_from(arguments.text("--frames"))),
        roots_(roots_of(arguments)) {
    request_.given = picture_choice(arguments, PictureUse::render);
    request_.further = [this](const Scene& scene) { return further_cameras(arguments_, scene); };
    request_.frames = [this](const EpisodeRecord& episode, WhichFrames otherwise) {
      return frames_of(frames_, episode, otherwise);
    };
    request_.lacking = [this](const EpisodeRecord& episode) { return lacking(frames_, episode); };
    request_.stop = console.stop;
    rules_ = output_rules(arguments, console);
    if (place_ == "--video") film_.emplace(target_, rules_);
    if (place_ == "--sheet") check_output(target_, sheet_kind(), rules_);
    workers_ = workers_of(arguments);
  }

  ExitCode run() {
    if (place_ == "--overlay") return render_overlays(arguments_, request_, console_);
    std::vector<std::int64_t> wanted;
    for (const std::string& text : arguments_.list("EPISODE")) wanted.push_back(episode_number(text));
    Shelf shelf(arguments_.text("FILE"), place_ == "--into" ? target_ : fs::path());
    if (wanted.empty())
      for (const EpisodeSummary& episode : shelf.episodes()) wanted.push_back(episode.id);
    text_.object().key("episodes").array();
    // A film's pictures follow each other, so one thread draws it.
    in_order(
        wanted.size(), {film_ ? 1 : workers_, request_.stop}, [] { return make_renderer(); },
        [&](std::unique_ptr<Renderer>& renderer, std::size_t i) { return draw(*renderer, shelf.read(wanted[i])); },
        [&](std::size_t, Drawn drawn) { keep(drawn, shelf); });
    const bool interrupted = request_.stopped() && done_ + skipped_ < static_cast<std::int64_t>(wanted.size());
    if (!interrupted && film_) film_->finish();
    if (!interrupted && place_ == "--sheet" && !blocks_.empty()) write_sheet(target_, blocks_, rules_);
    shelf.close();
    return answer(static_cast<std::int64_t>(wanted.size()), interrupted);
  }

 private:
  Drawn draw(Renderer& renderer, StoredEpisode stored) {
    Drawn drawn;
    drawn.stored = std::move(stored);
    if (!drawn.stored.scene) return drawn;
    drawn.changed = changed_scripts(drawn.stored.episode, roots_);
    drawn.stored.scene = with_cameras(drawn.stored, request_.further(*drawn.stored.scene), request_.named());
    check_choice(request_.given, *drawn.stored.scene);
    if (film_) {
      film_->add(renderer, request_, drawn);
    } else if (place_ == "--sheet") {
      drawn.canvases.push_back(sheet_block(renderer, request_, drawn));
    } else {
      draw_images(renderer, drawn);
    }
    if (!request_.stopped() && place_ == "--out") write_folder(target_, drawn, rules_);
    return drawn;
  }

  void draw_images(Renderer& renderer, Drawn& drawn) {
    const EpisodeRecord& episode = drawn.stored.episode;
    const Observation observation = chosen(before(request_.given, observation_of(episode)));
    const bool none = observation.images == WhichFrames::none;
    const auto frames = request_.frames(episode, none ? WhichFrames::all : observation.images);
    drawn.rendered = render_stored(renderer, drawn.stored, observation, frames, request_.stop);
    if (!drawn.rendered.images) return;  // interrupted
    drawn.pictures = static_cast<std::int64_t>(drawn.rendered.images->count());
    drawn.bytes = drawn.rendered.images->bytes();
    drawn.frames = static_cast<std::int64_t>(frames.size());
  }

  void keep(Drawn& drawn, Shelf& shelf) {
    const StoredEpisode& stored = drawn.stored;
    if (!stored.scene) {
      ++skipped_;
      console_.err << fmt::format("episode {} is left out: {}\n", stored.id, stored.why_not);
      return;
    }
    if (place_ == "--into") drawn.skipped = shelf.add(drawn).skipped;
    if (const std::string frames = request_.lacking(stored.episode); !frames.empty()) {
      console_.err << fmt::format("episode {} {}\n", stored.id, frames);
      if (request_.frames(stored.episode, WhichFrames::all).empty()) ++without_;
    }
    for (Canvas& block : drawn.canvases) blocks_.push_back(std::move(block));
    if (!drawn.changed.empty()) ++changed_episodes_;
    changed_.insert(drawn.changed.begin(), drawn.changed.end());
    ++done_;
    pictures_ += drawn.pictures;
    text_.object().field("episode", stored.id).field("frames", drawn.frames).field("pictures", drawn.pictures);
    text_.field("bytes", drawn.bytes).field("there_already", drawn.skipped).end();
    if (json_) return;
    const std::string from =
        stored.episode.real ? "recorded" : fmt::format("{} seed {}", stored.episode.variation, stored.episode.seed);
    console_.out << fmt::format("{:>5}  {} {}: {} pictures", stored.id, stored.episode.task, from, drawn.pictures);
    if (drawn.bytes > 0)
      console_.out << fmt::format(" of {} frames, {:.0f} kB", drawn.frames, static_cast<double>(drawn.bytes) / 1000);
    if (drawn.skipped > 0) console_.out << fmt::format(", {} were there already", drawn.skipped);
    console_.out << std::endl;
  }

  ExitCode answer(std::int64_t asked, bool interrupted) {
    if (!changed_.empty())
      console_.err << fmt::format(
          "scripts changed since {} of the episodes ran ({}): drawn from what the catalogue stored\n",
          changed_episodes_, joined({changed_.begin(), changed_.end()}));
    text_.end().field("pictures", pictures_).field("skipped", skipped_).field("interrupted", interrupted);
    if (json_) console_.out << text_.end().text();
    if (interrupted) console_.err << fmt::format("interrupted: {} of {} episodes are drawn\n", done_, asked);
    if (interrupted) return kInterrupted;
    return done_ == without_ ? kNo : kDone;
  }

  const Arguments& arguments_;
  Console& console_;
  bool json_;
  std::string place_;
  fs::path target_;
  OutputRules rules_;
  FrameChoice frames_;
  Roots roots_;
  RenderRequest request_;
  int workers_ = 1;
  std::optional<Film> film_;
  std::vector<Canvas> blocks_;
  JsonText text_;
  std::set<std::string> changed_;
  std::int64_t done_ = 0, skipped_ = 0, pictures_ = 0, changed_episodes_ = 0;
  std::int64_t without_ = 0;  // of those done: none of the frames that were asked for
};

ExitCode do_render(const Arguments& arguments, Console& console) { return Rendering(arguments, console).run(); }

}  // namespace

CommandRow render_command() {
  CommandRow row{
      "render",
      "Draw stored episodes: as files, into the catalogue, as a film or a contact sheet",
      "Needs the catalogue only: the scene and the frames that it stored, and no scripts. Without further words the "
      "pictures are those that `run` would have stored for the episode, byte for byte. A film and a contact sheet have "
      "the instruction and the skills written under the pictures; unless --camera names others, each skill is shown by "
      "the camera that sees most of what it handles. Ctrl-C keeps the episodes that are finished. "
      "Episodes without a scene are left out, with a line that says so.",
      {{"FILE", "the catalogue", true, false}, {"EPISODE", "numbers of episodes; default: all", false, true}},
      {{"--out",
        "FOLDER",
        "files: FOLDER/episode_000012/front/rgb/000034.png, masks.csv, cameras.csv",
        Takes::output,
        "",
        {},
        false},
       {"--into", "FILE", "the catalogue that takes the pictures, usually the same", Takes::path, "", {}, false},
       {"--video", "FILE", "a film (.mp4) at the rate of the frames", Takes::output, "", {}, false},
       {"--sheet",
        "FILE",
        "a contact sheet (PNG): the start, a picture amid each skill, the end",
        Takes::output,
        "",
        {},
        false},
       {"--overlay",
        "FOLDER",
        "the robot at the recorded joint states, tinted and outlined over the stored pictures, and by how many pixels "
        "its "
        "outline is off in each camera; 20 frames unless --frames says which",
        Takes::output,
        "",
        {},
        false},
       {"--frames",
        "WHICH",
        "all, keyframes, or numbers such as 0,10-20; default: as the episode was run, else all",
        Takes::text,
        "",
        {},
        false}},
      {"stampede render demos.db --camera front --size 512x512 --kinds rgb,depth --out pictures",
       "stampede render demos.db --into demos.db --frames keyframes", "stampede render demos.db 3 --video demo.mp4",
       "stampede render demos.db 1 2 3 --sheet sheet.png"},
      do_render};
  for (OptionRow& option : picture_options(PictureUse::render)) row.options.push_back(std::move(option));
  row.options.push_back(
      {"--workers", "W", "cores to use, default: all; they do not change the pictures", Takes::integer, "", {}, false});
  return row;
}

}  // namespace stampede::program
