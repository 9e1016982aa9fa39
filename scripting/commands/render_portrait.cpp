// Pictures for people: smoothed, with shadows, words beside them.
#include <algorithm>

#include "engine/record/observation.h"
#include "scripting/commands/render_output.h"

namespace stampede::program {
namespace {

constexpr int kSamples = 2;  // a pixel and side
constexpr const char* kUsualCamera = "front";

// Cameras that stay where they are, all when there is none: people want to see the hand, not what the hand sees.
std::vector<std::string> standing(const Scene& scene) {
  std::vector<std::string> names, all;
  for (const Camera& camera : scene.cameras) {
    all.push_back(camera.name);
    if (camera.mount_body.empty()) names.push_back(camera.name);
  }
  return names.empty() ? all : names;
}

}  // namespace

Portrait portrait_of(const RenderRequest& request, const StoredEpisode& stored, std::array<int, 2> size) {
  Portrait portrait;
  if (stored.scene->cameras.empty())
    throw Error("--camera", "the scene has no camera", "bring one along by --add-camera");
  ObservationChoice choice = request.given;
  portrait.all = choice.cameras.has_value();
  if (!portrait.all) choice.cameras = standing(*stored.scene);
  if (!choice.size) choice.size = size;
  portrait.observation = chosen(choice);
  portrait.observation.shadows = true;
  portrait.observation.kinds = {true, false, false, false};
  return portrait;
}

PortraitPainter::PortraitPainter(Renderer& renderer, const StoredEpisode& stored, const Portrait& portrait)
    : renderer_(renderer),
      stored_(stored),
      portrait_(portrait),
      shots_(shots_of(stored.episode, *stored.scene)),
      painter_(renderer, stored.episode, stored.scene, portrait.observation) {
  const std::vector<std::string>& cameras = portrait.observation.cameras;
  if (portrait.all || cameras.size() == 1) return;
  const auto found = std::find(cameras.begin(), cameras.end(), kUsualCamera);
  const auto usual = static_cast<std::size_t>(found == cameras.end() ? 0 : found - cameras.begin());
  choose_cameras(renderer, stored, cameras, usual, shots_);
}

int PortraitPainter::width() const {
  return portrait_.observation.width * (portrait_.all ? static_cast<int>(painter_.cameras().size()) : 1);
}
int PortraitPainter::height() const { return portrait_.observation.height; }

void PortraitPainter::paint(std::int64_t frame, Canvas& canvas, int x, int y) {
  const ScenePoses poses = scene_poses(*stored_.scene, state_at(*stored_.scene, stored_.episode, frame));
  const DrawOptions options{portrait_.observation.kinds, portrait_.observation.shadows, kSamples,
                            portrait_.observation.renderer};
  std::vector<View> views = painter_.views(frame);
  if (!portrait_.all) {
    const auto shot = std::find_if(shots_.begin(), shots_.end(), [&](const Shot& s) { return frame < s.end_frame; });
    views = {views[shot->camera]};
  }
  renderer_.draw(poses, views, options, pictures_);
  for (const Picture& picture : pictures_) {
    canvas.put(x, y, picture);
    x += picture.width;
  }
}

std::string instruction_of(const EpisodeRecord& episode) {
  for (const LanguageRecord& one : episode.labels.language)
    if (one.level == LanguageLevel::task) return one.text;
  return episode.task;
}

const SegmentRecord* skill_at(const EpisodeRecord& episode, std::int64_t frame) {
  const SegmentRecord* found = nullptr;
  for (const SegmentRecord& segment : episode.labels.segments)
    if (segment.kind == SegmentKind::skill && segment.span.first_frame <= frame &&
        (frame < segment.span.end_frame || segment.span.end_frame >= static_cast<std::int64_t>(episode.frames.size())))
      found = &segment;
  return found;
}

std::string label_of(const SegmentRecord& segment) {
  if (!segment.label.empty()) return segment.label;
  std::string text = segment.skill;
  for (const std::string& argument : segment.arguments) text += " " + argument;
  return text;
}

}  // namespace stampede::program
