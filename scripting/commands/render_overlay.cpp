// The robot drawn over stored pictures, and how far it is from where they show it.
#include "scripting/commands/render_overlay.h"

#include <fmt/format.h>

#include <map>
#include <ostream>
#include <set>

#include "db/recording/overlay.h"
#include "engine/base/file_name.h"
#include "engine/base/nearest.h"
#include "engine/base/output_file.h"
#include "engine/render/png.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/picture_options.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kEvenly = 20;  // frames, where nobody says which

std::vector<std::int64_t> spread(const Catalogue& catalogue, std::int64_t id) {
  std::vector<std::int64_t> with;
  for (const ImageEntry& entry : catalogue.images(id))
    if (entry.kind == "rgb" && (with.empty() || with.back() != entry.frame)) with.push_back(entry.frame);
  const auto count = static_cast<std::int64_t>(with.size());
  if (count <= kEvenly) return with;
  std::vector<std::int64_t> some;
  for (std::int64_t i = 0; i < kEvenly; ++i)
    some.push_back(with[static_cast<std::size_t>(i * (count - 1) / (kEvenly - 1))]);
  return some;
}

// Cameras that were asked for and of which there is no colour picture.
void name_missing(const Catalogue& catalogue, std::int64_t id, const std::vector<std::string>& cameras,
                  Console& console) {
  std::set<std::string> with;
  for (const ImageEntry& entry : catalogue.images(id))
    if (entry.kind == "rgb") with.insert(entry.camera);
  for (const std::string& camera : cameras)
    if (!with.contains(camera))
      console.err << fmt::format("episode {} has no colour pictures of camera {}; {}\n", id, camera,
                                 with.empty() ? "it has none" : did_you_mean(camera, {with.begin(), with.end()}));
}

// Pictures of one episode; each says that it is ours.
class Album {
 public:
  Album(const fs::path& folder, std::int64_t id, const OutputRules& rules)
      : folder_(folder), within_(fmt::format("episode_{:06}", id)), rules_(rules) {}

  void save(const OverlayPicture& picture) {
    std::string& camera = cameras_[picture.camera];
    if (camera.empty()) camera = names_.take(picture.camera);
    const Bytes png = marked_png(picture.width, picture.height, picture.rgb);
    const fs::path file = fs::path(camera) / fmt::format("{:06}.png", picture.frame);
    OutputFolder(folder_, file, sheet_kind(), rules_, within_)
        .write(file, {reinterpret_cast<const char*>(png.data()), png.size()});
  }

 private:
  fs::path folder_, within_;
  const OutputRules& rules_;
  FileNames names_;
  std::map<std::string, std::string> cameras_;  // folders
};

void print(const CameraAlignment& one, Console& console) {
  const Alignment& a = one.alignment;
  console.out << fmt::format(
      "       {}: {} pictures, outline off by {:.2f} px (median), {:.2f} px (95 %), shift {:+.2f} {:+.2f} px, "
      "{:.0f} % of {} points have an edge\n",
      one.camera, one.pictures, a.median_px, a.p95_px, a.shift_px[0], a.shift_px[1],
      100.0 * static_cast<double>(a.found) / static_cast<double>(std::max<std::int64_t>(a.points, 1)), a.points);
}

void put(const CameraAlignment& one, JsonText& json) {
  const Alignment& a = one.alignment;
  json.object().field("camera", one.camera).field("pictures", one.pictures).field("points", a.points);
  json.field("with_edge", a.found)
      .field("median_px", a.median_px)
      .field("p95_px", a.p95_px)
      .field("mean_px", a.mean_px);
  json.field("shift_x_px", a.shift_px[0]).field("shift_y_px", a.shift_px[1]).end();
}

}  // namespace

ExitCode render_overlays(const Arguments& arguments, const RenderRequest& request, Console& console) {
  const fs::path folder = arguments.text("--overlay");
  const OutputRules rules = output_rules(arguments, console);
  for (const char* option : {"--kinds", "--noise", "--renderer", "--size"})
    if (arguments.has(option))
      throw UsageError(std::string(option) + " is not for --overlay: its pictures are those stored");
  const Catalogue catalogue = Catalogue::open(arguments.text("FILE"));
  std::vector<std::int64_t> ids;
  for (const std::string& text : arguments.list("EPISODE")) ids.push_back(episode_number(text));
  if (ids.empty())
    for (const EpisodeSummary& episode : catalogue.episodes()) ids.push_back(episode.id);
  const std::unique_ptr<Renderer> renderer = make_renderer();
  JsonText json;
  json.object().key("episodes").array();
  std::int64_t done = 0;
  for (const std::int64_t id : ids) {
    if (request.stopped()) break;
    StoredEpisode stored = read_stored(catalogue, id);
    if (!stored.scene) {
      console.err << fmt::format("episode {} is left out: {}\n", id, stored.why_not);
      continue;
    }
    OverlayRequest wanted;
    wanted.cameras = request.named();
    wanted.frames =
        arguments.has("--frames") ? request.frames(stored.episode, WhichFrames::all) : spread(catalogue, id);
    stored.scene = with_cameras(stored, request.further(*stored.scene), request.named());
    Album album(folder, id, rules);
    const Overlays result =
        overlays_of(*renderer, catalogue, stored, wanted, [&](const OverlayPicture& picture) { album.save(picture); });
    if (const std::string frames = request.lacking(stored.episode); !frames.empty())
      console.err << fmt::format("episode {} {}\n", id, frames);
    name_missing(catalogue, id, wanted.cameras, console);
    for (const std::string& camera : result.left_out)
      console.err << fmt::format("episode {}: camera {} was not calibrated: give --camera-file\n", id, camera);
    if (result.cameras.empty())
      console.err << fmt::format("episode {}: no colour picture of these cameras and frames can be compared\n", id);
    else
      ++done;
    json.object().field("episode", id).key("cameras").array();
    if (!arguments.flag("--json")) console.out << fmt::format("{:>5}  {}\n", id, stored.episode.task);
    for (const CameraAlignment& one : result.cameras) {
      put(one, json);
      if (!arguments.flag("--json")) print(one, console);
    }
    json.end().end();
  }
  if (arguments.flag("--json")) console.out << json.end().end().text();
  if (request.stopped()) return kInterrupted;
  return done == 0 ? kNo : kDone;
}

}  // namespace stampede::program
