#include "db/episode_writer.h"

#include <cmath>

#include "db/catalogue_impl.h"
#include "db/table_text.h"
#include "engine/base/hash.h"
#include "engine/model/camera.h"

namespace stampede {
namespace {

// Seed and split are columns of episode: with them, hardly two episodes would share an engine run.
std::string options_text(const EpisodeRecord& episode) {
  std::string text = "{";
  for (const auto& [name, value] : episode.options) {
    if (name == "seed" || name == "split") continue;
    text += (text.size() > 1 ? "," : "") + json_text(name) + ":" + json_text(value);
  }
  return text + "}";
}

std::string_view name_of(ObjectKind kind) {
  switch (kind) {
    case ObjectKind::body:
      return "body";
    case ObjectKind::part:
      return "part";
    case ObjectKind::region:
      return "region";
    case ObjectKind::hand:
      return "hand";
  }
  return "body";
}

void require(bool condition, const EpisodeRecord& episode, const std::string& complaint) {
  if (!condition)
    throw Error("episode of " + episode.task + ", seed " + std::to_string(episode.seed), complaint,
                "the record was put together wrongly");
}

}  // namespace

void check_record(const EpisodeRecord& episode) {
  require(!episode.key.empty(), episode, "it has no key");
  require(episode.physics_hz > 0 && episode.frame_hz > 0, episode, "its rates must be above zero");
  for (const FrameRecord& frame : episode.frames) {
    const bool joints = frame.joint_position.size() == episode.joints.size() &&
                        frame.joint_velocity.size() == episode.joints.size() &&
                        frame.joint_effort.size() == episode.joints.size();
    require(joints, episode, "a frame has another number of joints than the episode");
    require(frame.object_pose.size() == episode.posed.size(), episode, "a frame has another number of posed objects");
    require(frame.hands.size() == episode.hands.size(), episode, "a frame has another number of hands");
    require(frame.camera_pose.empty() || frame.camera_pose.size() == episode.cameras.size(), episode,
            "a frame has another number of cameras");
  }
  for (const FactRecord& fact : episode.facts)
    require(fact.fact.arguments.size() <= 4, episode, "the fact " + to_text(fact.fact) + " has more than 4 arguments");
  for (const ChannelRecord& channel : episode.channels)
    require(channel.values.size() == channel.steps.size() * channel.components.size(), episode,
            "channel " + channel.name + " has another number of values than its steps and components say");
  std::set<int> instances;
  for (const MaskEntry& mask : episode.masks)
    require(mask.instance > 0 && mask.semantic > 0 && instances.insert(mask.instance).second, episode,
            "the mask of " + mask.name + " has a number that is not its own");
  if (episode.images)
    check_images(*episode.images, static_cast<std::int64_t>(episode.frames.size()), episode.cameras.size(),
                 "episode of " + episode.task + ", seed " + std::to_string(episode.seed));
}

void EpisodeWriter::write(std::int64_t id, const EpisodeRecord& episode, const EngineInfo& engine) {
  id_ = id;
  write_variation(episode);
  write_episode(episode, engine);
  write_masks(episode);
  write_objects(episode);
  write_names(episode);
  write_cameras(episode);  // their mounts are named by masks and objects
  write_frames(episode);
  write_images(episode);
  write_streams(episode);
  write_labels(episode);
}

void EpisodeWriter::write_streams(const EpisodeRecord& episode) {
  int ordinal = 0;
  for (const StreamRecord& s : episode.streams)
    stream_.run(id_, ordinal++, s.kind, s.name, s.file, s.clock, s.offset_s, s.drift_ppm, s.reference_s, s.origin_s,
                s.rate_hz, s.readings, s.longest_gap_s, s.missing, s.rule);
  for (const ImageTimeRecord& i : episode.image_times) image_time_.run(id_, i.frame, i.camera, i.kind, i.time_s);
}

void EpisodeWriter::write_variation(const EpisodeRecord& episode) {
  if (episode.real) return;
  variation_.run(episode.task, episode.variation);
  for (const auto& [axis, value] : episode.axes) variation_axis_.run(episode.task, episode.variation, axis, value);
}

std::string EpisodeWriter::write_engine_run(const EpisodeRecord& episode, const EngineInfo& engine) {
  const std::string options = options_text(episode);
  Hasher hasher;
  hasher.text(engine.version).text(engine.numerics).text(options);
  std::set<std::tuple<std::string, std::string, std::string>> names;  // in one order, whatever the record's
  for (const DefinitionRecord& d : episode.definitions) names.emplace(d.kind, d.name, d.hash);
  for (const auto& [kind, name, hash] : names) hasher.text(kind).text(name).text(hash);
  for (const auto& [name, kind] : episode.predicates) hasher.text(name).text(kind);
  const std::string run = hasher.digest();
  engine_run_.run(run, engine.version, engine.numerics, options);
  if (sqlite3_changes(database_.handle()) == 0) return run;
  for (const DefinitionRecord& d : episode.definitions) {
    definition_.run(d.kind, d.name, d.hash, d.path, d.source);
    engine_run_definition_.run(run, d.kind, d.name, d.hash);
  }
  for (const auto& [name, kind] : episode.predicates) predicate_.run(run, name, kind);
  return run;
}

std::string EpisodeWriter::write_scene(const std::string& document) {
  const std::string hash = content_hash(document);
  const PackedScene packed = pack_scene(document);
  scene_.run(hash, packed.document);
  if (sqlite3_changes(database_.handle()) == 0) return hash;
  for (const auto& [asset, body] : packed.assets) asset_.run(asset, body);
  return hash;
}

std::string EpisodeWriter::write_text(const std::string& text) {
  const std::string hash = content_hash(text);
  text_store_.run(hash, text);
  return hash;
}

void EpisodeWriter::write_episode(const EpisodeRecord& e, const EngineInfo& engine) {
  const std::string run = write_engine_run(e, engine);
  std::optional<std::string> scene;  // a start that could not be made has none
  if (!e.scene_document.empty()) scene = write_scene(e.scene_document);
  const double duration = e.duration_s();
  const auto simulated = [&](const auto& value) { return e.real ? std::nullopt : std::optional(value); };
  const auto variation = simulated(e.variation), state_hash = simulated(e.state_hash);
  episode_.run(id_, e.key, e.task, e.world, variation, simulated(e.seed), to_string(e.split),
               e.outcome == Outcome::success ? "success" : "failure", to_string(e.reason), e.detail, e.beside_goal,
               e.frames.size(), e.steps, duration, e.physics_hz, e.frame_hz, simulated(e.draws), state_hash,
               e.real ? "real" : "sim", scene, run);
  timing_.run(id_, e.wall_s, e.physics_wall_s);
}

void EpisodeWriter::write_objects(const EpisodeRecord& episode) {
  std::map<std::string, int> masks;
  for (const MaskEntry& mask : episode.masks) masks.emplace(mask.name, mask.instance);
  int ordinal = 0;
  for (const Object& o : episode.objects) {
    const auto mask = masks.find(o.name);
    object_.run(id_, ordinal, o.name, name_of(o.kind), o.class_name, o.type, o.body, o.part, o.size.x(), o.size.y(),
                o.size.z(), mask == masks.end() ? 0 : mask->second);
    int place = 0;
    for (const std::string& trait : o.traits) object_trait_.run(id_, ordinal, place++, trait);
    for (const auto& [name, value] : o.attributes) object_attribute_.run(id_, ordinal, name, value);
    for (const auto& [name, value] : o.numbers) object_attribute_.run(id_, ordinal, name, value);
    ++ordinal;
  }
}

void EpisodeWriter::write_names(const EpisodeRecord& episode) {
  int ordinal = 0;
  for (const std::string& name : episode.posed) posed_.run(id_, ordinal++, name);
  ordinal = 0;
  for (const std::string& name : episode.hands) hand_.run(id_, ordinal++, name);
  ordinal = 0;
  for (const JointName& j : episode.joints)
    joint_.run(id_, ordinal++, j.name, j.part.body, j.part.part, j.kind, j.unit, j.lower, j.upper, j.driven);
}

void EpisodeWriter::write_cameras(const EpisodeRecord& episode) {
  int ordinal = 0;
  for (const Camera& camera : episode.cameras) write_camera(ordinal++, camera);
}

void EpisodeWriter::write_camera(int ordinal, const Camera& c) {
  const auto& [k1, k2, p1, p2, k3] = c.distortion;
  const std::string link = mount_link(c), matrix = matrix_text(c.mount_from_camera);
  camera_.run(id_, ordinal, c.name, c.width, c.height, c.focal_x, c.focal_y, c.centre_x, c.centre_y, k1, k2, p1, p2, k3,
              c.near_m, c.far_m, c.mount_body, c.mount_part, link, vertical_field_of_view(c), matrix,
              to_pose(c.mount_from_camera));
}

}  // namespace stampede
