#include "db/episode_writer.h"

#include <set>

#include "db/catalogue_impl.h"
#include "db/insert.h"

namespace stampede {
namespace {

void require(bool condition, const EpisodeRecord& episode, const std::string& complaint) {
  if (!condition)
    throw Error("episode of " + episode.task + ", seed " + std::to_string(episode.seed), complaint,
                "the record was put together wrongly");
}

}  // namespace

void check_record(const EpisodeRecord& episode) {
  require(!episode.made.key.empty(), episode, "it has no key");
  require(episode.physics_hz > 0 && episode.frame_hz > 0, episode, "its rates must be above zero");
  for (const FrameRecord& frame : episode.frames) {
    const bool joints = frame.joint_position.size() == episode.scene.joints.size() &&
                        frame.joint_velocity.size() == episode.scene.joints.size() &&
                        frame.joint_effort.size() == episode.scene.joints.size();
    require(joints, episode, "a frame has another number of joints than the episode");
    require(frame.object_pose.size() == episode.scene.posed.size(), episode,
            "a frame has another number of posed objects");
    require(frame.hands.size() == episode.scene.hands.size(), episode, "a frame has another number of hands");
    require(frame.camera_pose.empty() || frame.camera_pose.size() == episode.scene.cameras.size(), episode,
            "a frame has another number of cameras");
  }
  for (const FactRecord& fact : episode.labels.facts)
    require(fact.fact.arguments.size() <= 4, episode, "the fact " + to_text(fact.fact) + " has more than 4 arguments");
  for (const ChannelRecord& channel : episode.channels)
    require(channel.values.size() == channel.steps.size() * channel.components.size(), episode,
            "channel " + channel.name + " has another number of values than its steps and components say");
  std::set<int> instances;
  for (const MaskEntry& mask : episode.scene.masks)
    require(mask.instance > 0 && mask.semantic > 0 && instances.insert(mask.instance).second, episode,
            "the mask of " + mask.name + " has a number that is not its own");
  if (episode.images)
    check_images(*episode.images, static_cast<std::int64_t>(episode.frames.size()), episode.scene.cameras.size(),
                 "episode of " + episode.task + ", seed " + std::to_string(episode.seed));
}

EpisodeWriter::EpisodeWriter(const sql::Database& database)
    : shared_(database),
      cameras_(database),
      frames_(database, cameras_),
      images_(database, cameras_),
      labels_(database),
      episode_(insert(database, "episode",
                      "id, key, task, world, variation, seed, split, outcome, reason, detail, beside_goal, frames, "
                      "steps, duration_s, physics_hz, frame_hz, draws, state_hash, source, scene, engine_run")),
      timing_(insert(database, "timing", "episode, wall_s, physics_wall_s")),
      object_(insert(database, "object",
                     "episode, ordinal, name, kind, class, type, body, part, size_x, size_y, size_z, mask_id")),
      object_trait_(insert(database, "object_trait", "episode, object, ordinal, trait")),
      object_attribute_(insert(database, "object_attribute", "episode, object, name, value")),
      posed_(insert(database, "posed", "episode, ordinal, name")),
      joint_(insert(database, "joint", "episode, ordinal, name, body, part, kind, unit, lower, upper, driven")),
      hand_(insert(database, "hand", "episode, ordinal, name")),
      stream_(insert(database, "stream",
                     "episode, ordinal, kind, name, file, clock, offset_s, drift_ppm, reference_s, origin_s, rate_hz, "
                     "readings, longest_gap_s, missing, rule")),
      image_time_(insert(database, "image_time", "episode, frame, camera, kind, time_s")) {}

void EpisodeWriter::write(std::int64_t id, const EpisodeRecord& episode, const EngineInfo& engine) {
  shared_.write_variation(episode);
  write_episode(id, episode, engine);
  images_.write_masks(id, episode);
  write_objects(id, episode);
  write_names(id, episode);
  int ordinal = 0;  // of cameras, whose mounts are named by masks and objects
  for (const Camera& camera : episode.scene.cameras) cameras_.write(id, ordinal++, camera);
  frames_.write(id, episode);
  images_.write(id, episode);
  write_streams(id, episode);
  labels_.write(id, episode);
}

void EpisodeWriter::set_labels(std::int64_t id, const EpisodeRecord& episode) {
  labels_.replace(id, episode);
  frames_.set_running(id, episode);
}

AddedImages EpisodeWriter::add_images(std::int64_t id, const ImageStore& images,
                                      const std::vector<CameraTrack>& cameras) {
  return images_.add(id, images, cameras);
}

void EpisodeWriter::write_episode(std::int64_t id, const EpisodeRecord& e, const EngineInfo& engine) {
  const std::string run = shared_.write_engine_run(e, engine);
  std::optional<std::string> scene;  // a start that could not be made has none
  if (!e.scene.document.empty()) scene = shared_.write_scene(e.scene.document);
  const double duration = e.duration_s();
  const auto simulated = [&](const auto& value) { return e.real ? std::nullopt : std::optional(value); };
  const auto variation = simulated(e.variation), state_hash = simulated(e.state_hash);
  episode_.run(id, e.made.key, e.task, e.world, variation, simulated(e.seed), to_string(e.made.split),
               e.outcome == Outcome::success ? "success" : "failure", to_string(e.reason), e.detail, e.beside_goal,
               e.frames.size(), e.steps, duration, e.physics_hz, e.frame_hz, simulated(e.made.draws), state_hash,
               e.real ? "real" : "sim", scene, run);
  timing_.run(id, e.made.wall_s, e.made.physics_wall_s);
}

void EpisodeWriter::write_objects(std::int64_t id, const EpisodeRecord& episode) {
  std::map<std::string, int> masks;
  for (const MaskEntry& mask : episode.scene.masks) masks.emplace(mask.name, mask.instance);
  int ordinal = 0;
  for (const Object& o : episode.scene.objects) {
    const auto mask = masks.find(o.name);
    object_.run(id, ordinal, o.name, to_string(o.kind), o.class_name, o.type, o.body, o.part, o.size.x(), o.size.y(),
                o.size.z(), mask == masks.end() ? 0 : mask->second);
    int place = 0;
    for (const std::string& trait : o.traits) object_trait_.run(id, ordinal, place++, trait);
    for (const auto& [name, value] : o.attributes) object_attribute_.run(id, ordinal, name, value);
    for (const auto& [name, value] : o.numbers) object_attribute_.run(id, ordinal, name, value);
    ++ordinal;
  }
}

void EpisodeWriter::write_names(std::int64_t id, const EpisodeRecord& episode) {
  int ordinal = 0;
  for (const std::string& name : episode.scene.posed) posed_.run(id, ordinal++, name);
  ordinal = 0;
  for (const std::string& name : episode.scene.hands) hand_.run(id, ordinal++, name);
  ordinal = 0;
  for (const JointName& j : episode.scene.joints)
    joint_.run(id, ordinal++, j.name, j.part.body, j.part.part, j.kind, j.unit, j.lower, j.upper, j.driven);
}

void EpisodeWriter::write_streams(std::int64_t id, const EpisodeRecord& episode) {
  int ordinal = 0;
  for (const StreamRecord& s : episode.streams)
    stream_.run(id, ordinal++, s.kind, s.name, s.file, s.clock, s.offset_s, s.drift_ppm, s.reference_s, s.origin_s,
                s.rate_hz, s.readings, s.longest_gap_s, s.missing, s.rule);
  for (const ImageTimeRecord& i : episode.image_times) image_time_.run(id, i.frame, i.camera, i.kind, i.time_s);
}

}  // namespace stampede
