// Pictures for people: smoothed, with shadows, words beside them.
#include <algorithm>

#include "scripting/commands/render_output.h"

namespace stampede::program {
namespace {

constexpr int kSamples = 2;  // a pixel and side
constexpr const char* kUsualCamera = "front";

}  // namespace

Portrait portrait_of(const RenderRequest& request, const StoredEpisode& stored, std::array<int, 2> size) {
  Portrait portrait;
  portrait.scene = with_cameras(stored, request.further(*stored.scene), request.named());
  const std::vector<Camera>& all = portrait.scene->cameras;
  ObservationChoice choice = request.given;
  if (!choice.cameras) {
    if (all.empty()) throw Error("--camera", "the scene has no camera", "bring one along by --add-camera");
    const bool usual = std::any_of(all.begin(), all.end(), [](const Camera& c) { return c.name == kUsualCamera; });
    choice.cameras = {usual ? kUsualCamera : all.front().name};
  }
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
      painter_(renderer, stored.episode, portrait.scene, portrait.observation) {}

int PortraitPainter::width() const { return portrait_.observation.width * static_cast<int>(painter_.cameras().size()); }
int PortraitPainter::height() const { return portrait_.observation.height; }

void PortraitPainter::paint(std::int64_t frame, Canvas& canvas, int x, int y) {
  const ScenePoses poses = scene_poses(*portrait_.scene, state_at(*portrait_.scene, stored_.episode, frame));
  const DrawOptions options{portrait_.observation.kinds, portrait_.observation.shadows, kSamples};
  renderer_.draw(poses, painter_.views(frame), options, pictures_);
  for (const Picture& picture : pictures_) {
    canvas.put(x, y, picture);
    x += picture.width;
  }
}

std::string instruction_of(const EpisodeRecord& episode) {
  for (const LanguageRecord& one : episode.language)
    if (one.level == "task") return one.text;
  return episode.task;
}

const SegmentRecord* skill_at(const EpisodeRecord& episode, std::int64_t frame) {
  const SegmentRecord* found = nullptr;
  for (const SegmentRecord& segment : episode.segments)
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
