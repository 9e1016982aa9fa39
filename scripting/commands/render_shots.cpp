#include "scripting/commands/render_shots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "engine/model/masks.h"
#include "engine/record/observation.h"

namespace stampede::program {
namespace {

constexpr int kLook = 128;        // pixels a side of the pictures that are counted in
constexpr double kMuch = 0.25;    // power of a share: half of a thing is nearly all of it, none of it is none
constexpr double kStay = 0.8;     // of the best camera's worth: the last one stays where it reaches this
constexpr double kStill = 0.004;  // m: what goes less far stands still

bool is_fixture(const Scene& scene, const Object& object) {
  const int body = scene.body_index(object.body);
  return body >= 0 && scene.bodies[static_cast<std::size_t>(body)].fixture;
}

// What a segment names, and without one all that can move. The hand is where they are: it counts where it is alone.
std::vector<std::string> things_of(const EpisodeRecord& episode, const SegmentRecord* skill, const Scene& scene) {
  std::vector<std::string> things, hands;
  for (const std::string& name : skill != nullptr ? skill->arguments : episode.scene.posed) {
    const Object* object = scene.object(name);
    if (object == nullptr || is_fixture(scene, *object)) continue;
    (object->kind == ObjectKind::hand ? hands : things).push_back(name);
  }
  return things.empty() ? hands : things;
}

// Its middle, and the middles of three of its sides: what turns in its place moves these.
std::array<Vector3, 4> places_of(const Scene& scene, const ScenePoses& poses, const Object& object) {
  if (object.kind == ObjectKind::region) {
    const Vector3 at = poses.world_from_region[static_cast<std::size_t>(scene.region_index(object.name))].translation();
    return {at, at, at, at};
  }
  const auto body = static_cast<std::size_t>(scene.body_index(object.body));
  const auto part = static_cast<std::size_t>(object.kind == ObjectKind::part ? object.part : 0);
  const auto box = bounding_box(scene.bodies[body].parts[part]);  // a door's frame is its hinge, and stays where it is
  const Vector3 middle = (box[0] + box[1]) / 2, half = (box[1] - box[0]) / 2;
  const Transform& from_part = poses.world_from_part[body][part];
  return {from_part * middle, from_part * (middle + half.x() * Vector3::UnitX()),
          from_part * (middle + half.y() * Vector3::UnitY()), from_part * (middle + half.z() * Vector3::UnitZ())};
}

// How far the shot's things went from each of its frames to the next; the hand where nothing else moves.
std::vector<double> ways(const EpisodeRecord& episode, const Scene& scene, const Shot& shot) {
  std::vector<const Object*> things;
  for (const std::string& name : shot.things) {
    const Object* object = scene.object(name);
    if (object->kind == ObjectKind::region || scene.body_index(object->body) >= 0) things.push_back(object);
  }
  std::vector<double> by_things, by_hand;
  std::vector<std::array<Vector3, 4>> before;
  for (std::int64_t frame = shot.first_frame; frame < shot.end_frame; ++frame) {
    const ScenePoses poses = scene_poses(scene, state_at(scene, episode, frame));
    std::vector<std::array<Vector3, 4>> now;
    for (const Object* object : things) now.push_back(places_of(scene, poses, *object));
    double way = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      double most = 0;
      for (std::size_t k = 0; k < now[i].size(); ++k) most = std::max(most, (now[i][k] - before[i][k]).norm());
      way += most;
    }
    by_things.push_back(way);
    before = std::move(now);
    const auto& hands = episode.frames[static_cast<std::size_t>(frame)].hands;
    if (frame == shot.first_frame || hands.empty()) {
      by_hand.push_back(0);
      continue;
    }
    const HandRecord& last = episode.frames[static_cast<std::size_t>(frame - 1)].hands.front();
    by_hand.push_back((to_transform(hands.front().tip).translation() - to_transform(last.tip).translation()).norm());
  }
  double all = 0;
  for (const double way : by_things) all += way;
  return all < kStill ? by_hand : by_things;
}

// The frame in which the last of what the skill declared to become true did so, if any did.
std::optional<std::int64_t> comes_true(const EpisodeRecord& episode, const Shot& shot) {
  std::optional<std::int64_t> last;
  if (shot.skill == nullptr) return last;
  for (const EffectRecord& effect : shot.skill->declared_effects)
    for (const FactRecord& record : episode.labels.facts) {
      const bool here = record.first_frame > shot.first_frame && record.first_frame < shot.end_frame;
      if (!effect.negated && here && record.fact == effect.fact) last = std::max(last.value_or(0), record.first_frame);
    }
  return last;
}

std::int64_t halfway(const EpisodeRecord& episode, const Scene& scene, const Shot& shot) {
  const std::vector<double> lengths = ways(episode, scene, shot);
  double all = 0, gone = 0;
  for (const double length : lengths) all += length;
  for (std::size_t i = 0; i < lengths.size() && all > 0; ++i) {
    gone += lengths[i];
    if (gone >= all / 2) return shot.first_frame + static_cast<std::int64_t>(i);
  }
  return (shot.first_frame + shot.end_frame) / 2;
}

// The numbers that stand for a thing in instance masks; those of what an invisible region is fixed to.
std::set<int> numbers_of(const Scene& scene, const std::vector<MaskEntry>& masks, const std::string& thing) {
  std::set<int> numbers;
  for (const MaskEntry& mask : masks)
    if (mask.object == thing || mask.object.starts_with(thing + ".")) numbers.insert(mask.instance);
  if (const int region = scene.region_index(thing); numbers.empty() && region >= 0) {
    const Region& box = scene.regions[static_cast<std::size_t>(region)];
    if (const int body = scene.body_index(box.body); body >= 0)
      numbers.insert(scene.bodies[static_cast<std::size_t>(body)].parts[static_cast<std::size_t>(box.part)].instance);
  }
  numbers.erase(0);
  return numbers;
}

// The telling frame, and those between it and both ends.
std::set<std::int64_t> frames_looked_at(const Shot& shot) {
  return {(shot.first_frame + shot.telling_frame) / 2, shot.telling_frame,
          (shot.telling_frame + std::max(shot.telling_frame, shot.end_frame - 1)) / 2};
}

// Adds what each camera is worth at one moment: some of everything is worth more than all of one thing.
void add_worth(const std::vector<Picture>& pictures, const std::vector<std::set<int>>& things,
               std::vector<double>& worth) {
  for (const std::set<int>& numbers : things) {
    std::vector<double> seen;
    for (const Picture& picture : pictures)
      seen.push_back(static_cast<double>(std::count_if(picture.instance.begin(), picture.instance.end(),
                                                       [&](int number) { return numbers.contains(number); })));
    const double most = *std::max_element(seen.begin(), seen.end());
    for (std::size_t camera = 0; camera < seen.size() && most > 0; ++camera)
      worth[camera] += std::pow(seen[camera] / most, kMuch);
  }
}

}  // namespace

std::vector<Shot> shots_of(const EpisodeRecord& episode, const Scene& scene) {
  const auto count = static_cast<std::int64_t>(episode.frames.size());
  std::set<int> skills;
  std::vector<Shot> shots;
  for (const SegmentRecord& segment : episode.labels.segments) {
    if (segment.kind != SegmentKind::skill) continue;
    skills.insert(segment.ordinal);
    if (skills.contains(segment.parent)) continue;
    Shot& shot = shots.emplace_back();
    shot.skill = &segment;
    shot.first_frame = std::min(segment.span.first_frame, count - 1);
  }
  if (shots.empty()) shots.emplace_back();
  for (std::size_t i = 0; i < shots.size(); ++i) {
    Shot& shot = shots[i];
    const std::int64_t next = i + 1 < shots.size() ? shots[i + 1].first_frame : count;
    shot.end_frame = shot.skill != nullptr ? std::min(shot.skill->span.end_frame, next) : next;
    shot.things = things_of(episode, shot.skill, scene);
    const std::optional<std::int64_t> act = comes_true(episode, shot);
    shot.telling_frame = std::min(act ? *act : halfway(episode, scene, shot), count - 1);
    if (i == 0) shot.first_frame = 0;
    shot.end_frame = next;
  }
  return shots;
}

void choose_cameras(Renderer& renderer, const StoredEpisode& stored, const std::vector<std::string>& cameras,
                    std::size_t usual, std::vector<Shot>& shots) {
  Observation look;
  look.cameras = cameras;
  look.width = look.height = kLook;
  look.kinds = {false, false, true, false};
  EpisodePainter painter(renderer, stored.episode, stored.scene, look);
  const std::vector<MaskEntry> masks = mask_key(*stored.scene);
  std::vector<Picture> pictures;
  std::size_t last = usual;
  for (Shot& shot : shots) {
    std::vector<std::set<int>> things;
    for (const std::string& thing : shot.things) things.push_back(numbers_of(*stored.scene, masks, thing));
    std::vector<double> worth(cameras.size(), 0);
    for (const std::int64_t frame : frames_looked_at(shot)) {
      painter.paint(frame, pictures);
      add_worth(pictures, things, worth);
    }
    const auto best = std::max_element(worth.begin(), worth.end());
    if (worth[last] < kStay * *best) last = static_cast<std::size_t>(best - worth.begin());
    shot.camera = last;
  }
}

}  // namespace stampede::program
