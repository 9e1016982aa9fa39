#include <array>
#include <charconv>
#include <cmath>

#include "db/check_numbers.h"
#include "db/episode_reader.h"
#include "db/table_text.h"

namespace stampede {

void throw_no_episode(const sql::Database& database, std::int64_t id) {
  throw Error(database.path(), "there is no episode " + std::to_string(id),
              "`stampede query \"SELECT episode, task, outcome FROM episodes\"` lists them");
}

std::string to_json_list(const std::vector<std::string>& texts) {
  std::string json = "[";
  for (const std::string& text : texts) json += (json.size() > 1 ? "," : "") + json_text(text);
  return json + "]";
}

std::vector<std::string> from_json_list(const sql::Database& database, const std::string& json) {
  std::vector<std::string> texts;
  if (json == "[]") return texts;
  sql::Statement items(database, "SELECT value FROM json_each(?1) ORDER BY key");
  for (items.start(json); items.step();) items.read(texts.emplace_back());
  return texts;
}

std::string to_json_numbers(std::span<const double> numbers) {
  std::string json = "[";
  std::array<char, 32> digits{};
  for (const double number : numbers) {
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    json.append(json.size() > 1 ? "," : "").append(digits.data(), end);
  }
  return json + "]";
}

std::optional<std::vector<double>> from_json_numbers(std::string_view json) {
  std::vector<double> numbers;
  if (!json.starts_with('[') || !json.ends_with(']') || json.size() < 2) return std::nullopt;
  const char* next = json.data() + 1;
  const char* const end = json.data() + json.size() - 1;
  while (next < end) {
    const auto [stop, error] = std::from_chars(next, end, numbers.emplace_back());
    if (error != std::errc() || !std::isfinite(numbers.back()) || (stop < end && *stop != ',') || stop + 1 == end)
      return std::nullopt;
    next = stop + 1;
  }
  return numbers;
}

std::string matrix_text(const Transform& transform) {
  std::string text;
  std::array<char, 32> digits{};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) {
      const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), transform.matrix()(row, column)).ptr;
      text.append(text.empty() ? "" : " ").append(digits.data(), end);
    }
  return text;
}

Transform matrix_from(const std::string& text) {
  Transform transform = Transform::Identity();
  const char* next = text.data();
  const char* const end = next + text.size();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) {
      next = std::from_chars(next, end, transform.matrix()(row, column)).ptr;
      if (next < end) ++next;  // the space
    }
  return transform;
}

void read_camera(sql::Statement& row, Camera& c) {
  auto& [k1, k2, p1, p2, k3] = c.distortion;
  std::string matrix;
  row.read(c.name, c.width, c.height, c.focal_x, c.focal_y, c.centre_x, c.centre_y, k1, k2, p1, p2, k3, c.near_m,
           c.far_m, c.mount_body, c.mount_part, matrix);
  c.mount_from_camera = matrix_from(matrix);
}

std::string numbered(const std::string& name, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += (i > 0 ? ", " : "") + name + "_" + std::to_string(i);
  return text;
}

void EpisodeReader::take_values(const sql::Statement& row, int column, std::span<double> places, const char* table,
                                sql::UnknownValues unknown) const {
  const bool complete = unknown == sql::UnknownValues::refused && !record_.real;
  for (double& value : places) {
    if (sqlite3_column_type(row.handle(), column) == SQLITE_NULL && complete) damaged(table);
    value = known_or_nan(row, column++);
  }
}

void EpisodeReader::read_episode() {
  sql::Statement row(
      database_,
      "SELECT e.key, e.task, e.world, coalesce(e.variation, ''), coalesce(e.seed, 0), e.split, e.outcome, "
      "e.reason, e.detail, e.beside_goal, e.physics_hz, e.frame_hz, e.steps, coalesce(e.draws, 1), "
      "coalesce(e.state_hash, ''), "
      "e.engine_run, coalesce(s.document, ''), coalesce(t.wall_s, 0), coalesce(t.physics_wall_s, 0), "
      "e.frames, (SELECT count(*) FROM frame f WHERE f.episode = e.id), e.source FROM episode e LEFT JOIN scene s ON "
      "s.hash = "
      "e.scene "
      "LEFT JOIN timing t ON t.episode = e.id WHERE e.id = ?1");
  if (!row.start(id_).step()) throw_no_episode(database_, id_);
  EpisodeRecord& e = record_;
  std::string split, outcome, reason, scene, source;
  std::int64_t frames = 0, stored = 0, physics_hz = 0, frame_hz = 0;
  row.read(e.made.key, e.task, e.world, e.variation, e.seed, split, outcome, reason, e.detail, e.beside_goal,
           physics_hz, frame_hz, e.steps, e.made.draws, e.state_hash, run_, scene, e.made.wall_s, e.made.physics_wall_s,
           frames, stored, source);
  e.real = source == "real";
  const std::string here = "episode " + std::to_string(id_) + ", ";
  require_within(database_.path(), here + "physics_hz", physics_hz, 1, kMostHz);
  require_within(database_.path(), here + "frame_hz", frame_hz, 1, physics_hz);
  require_within(database_.path(), here + "frames", frames, stored, stored);  // memory is taken for as many
  require_within(database_.path(), here + "steps", e.steps, 0, std::int64_t{1} << 40);
  e.physics_hz = static_cast<int>(physics_hz), e.frame_hz = static_cast<int>(frame_hz);
  e.made.split = known_word(database_, "split", split, split_from(split));
  e.outcome = known_word(database_, "outcome", outcome, outcome_from(outcome));
  e.reason = known_word(database_, "reason", reason, reason_from(reason));
  e.scene.document = unpack_scene(database_, scene);
  e.frames.resize(static_cast<std::size_t>(frames));
  sql::Statement axes(database_, "SELECT axis, value FROM variation_axis WHERE task = ?1 AND variation = ?2");
  for (axes.start(e.task, e.variation); axes.step();) {
    std::string axis, value;
    axes.read(axis, value);
    e.axes[axis] = value;
  }
}

StoredRun read_stored_run(const sql::Database& database, const std::string& hash) {
  StoredRun run{hash, {}, {}, {}};
  sql::Statement engine(database, "SELECT engine_version, numerics FROM engine_run WHERE hash = ?1");
  if (engine.start(hash).step()) engine.read(run.engine.version, run.engine.numerics);
  sql::Statement options(database, "SELECT j.key, j.value FROM engine_run r, json_each(r.options) j WHERE r.hash = ?1");
  for (options.start(hash); options.step();) {
    std::string name, value;
    options.read(name, value);
    run.options[name] = value;
  }
  sql::Statement definitions(database,
                             "SELECT d.kind, d.name, d.path, d.source, d.hash FROM engine_run_definition r "
                             "JOIN definition d USING (kind, name, hash) WHERE r.engine_run = ?1 "
                             "ORDER BY d.kind, d.name, d.hash");
  for (definitions.start(hash); definitions.step();) {
    DefinitionRecord& d = run.definitions.emplace_back();
    definitions.read(d.kind, d.name, d.path, d.source, d.hash);
  }
  return run;
}

std::vector<StoredRun> Catalogue::runs() const {
  std::vector<StoredRun> runs;
  sql::Statement hashes(impl_->database, "SELECT hash FROM engine_run ORDER BY hash");
  for (hashes.start(); hashes.step();) {
    std::string hash;
    hashes.read(hash);
    runs.push_back(read_stored_run(impl_->database, hash));
  }
  return runs;
}

void EpisodeReader::read_run() {
  StoredRun run = read_stored_run(database_, run_);
  record_.made.options = std::move(run.options);
  record_.made.definitions = std::move(run.definitions);
  sql::Statement predicates(database_, "SELECT name, kind FROM predicate WHERE engine_run = ?1");
  for (predicates.start(run_); predicates.step();) {
    std::string name, kind;
    predicates.read(name, kind);
    record_.scene.predicates[name] = kind;
  }
}

void EpisodeReader::read_objects() {
  each("name, kind, class, type, body, part, size_x, size_y, size_z", "object", "ordinal", [&](sql::Statement& row) {
    Object& o = record_.scene.objects.emplace_back();
    std::string kind;
    row.read(o.name, kind, o.class_name, o.type, o.body, o.part, o.size.x(), o.size.y(), o.size.z());
    o.kind = known_word(database_, "kind", kind, object_kind_from(kind));
  });
  each("object, trait", "object_trait", "object, ordinal", [&](sql::Statement& row) {
    std::int64_t object = 0;
    std::string trait;
    row.read(object, trait);
    at(record_.scene.objects, object, "object_trait").traits.push_back(trait);
  });
  each("object, typeof(value), name, value", "object_attribute", "object, name", [&](sql::Statement& row) {
    std::int64_t object = 0;
    std::string type, name, value;
    row.read(object, type, name);
    Object& owner = at(record_.scene.objects, object, "object_attribute");
    if (type == "text") {
      row.read(object, type, name, value);
      owner.attributes[name] = value;
    } else {
      double number = 0;
      row.read(object, type, name, number);
      owner.numbers[name] = number;
    }
  });
}

void EpisodeReader::read_names() {
  each("name", "posed", "ordinal", [&](sql::Statement& row) { row.read(record_.scene.posed.emplace_back()); });
  each("name", "hand", "ordinal", [&](sql::Statement& row) { row.read(record_.scene.hands.emplace_back()); });
  each("name, body, part, kind, unit, lower, upper, driven", "joint", "ordinal", [&](sql::Statement& row) {
    JointName& j = record_.scene.joints.emplace_back();
    row.read(j.name, j.part.body, j.part.part, j.kind, j.unit, j.lower, j.upper, j.driven);
  });
}

void EpisodeReader::read_masks() {
  each("instance, name, object, class, semantic", "mask", "instance", [&](sql::Statement& row) {
    MaskEntry& m = record_.scene.masks.emplace_back();
    row.read(m.instance, m.name, m.object, m.class_name, m.semantic);
  });
}

void EpisodeReader::read_cameras() {
  each(kCameraColumns, "camera", "ordinal",
       [&](sql::Statement& row) { read_camera(row, record_.scene.cameras.emplace_back()); });
}

void EpisodeReader::read_channels() {
  each("name, unit, rate_hz", "channel", "ordinal", [&](sql::Statement& row) {
    ChannelRecord& c = record_.channels.emplace_back();
    row.read(c.name, c.unit, c.rate_hz);
  });
  each("channel, name", "channel_component", "channel, ordinal", [&](sql::Statement& row) {
    std::int64_t channel = 0;
    std::string name;
    row.read(channel, name);
    at(record_.channels, channel, "channel_component").components.push_back(name);
  });
  each("channel, part, step, " + numbered("value", kComponentsARow), "sample", "channel, ordinal, part",
       [&](sql::Statement& row) {
         std::int64_t channel = 0, step = 0;
         std::size_t part = 0;
         row.read(channel, part, step);
         ChannelRecord& owner = at(record_.channels, channel, "sample");
         if (part == 0) owner.steps.push_back(step);
         const std::size_t width = owner.components.size();
         if (part >= width || part * kComponentsARow >= width) damaged("sample");
         const std::size_t values = std::min(kComponentsARow, width - part * kComponentsARow);
         owner.values.resize(owner.values.size() + values);
         take_values(row, 3, std::span(owner.values).last(values), "sample", unknown_values_of(owner, record_));
       });
}

void EpisodeReader::read_frames() {
  const std::size_t joints = record_.scene.joints.size();
  for (FrameRecord& frame : record_.frames) {
    frame.joint_position.resize(joints), frame.joint_velocity.resize(joints), frame.joint_effort.resize(joints);
    frame.object_pose.resize(record_.scene.posed.size());
    frame.hands.resize(record_.scene.hands.size());
  }
  each("frame, step, reward, done", "frame", "frame", [&](sql::Statement& row) {
    std::int64_t frame = 0;
    row.read(frame);
    FrameRecord& f = at(record_.frames, frame, "frame");
    row.read(frame, f.step, f.reward, f.done);
    f.reward = known_or_nan(row, 2);
  });
  each("frame, part, " + numbered("position", kJointsARow) + ", " + numbered("velocity", kJointsARow) + ", " +
           numbered("effort", kJointsARow),
       "joint_state", "frame, part", [&](sql::Statement& row) {
         std::int64_t frame = 0;
         std::size_t part = 0;
         row.read(frame, part);
         FrameRecord& f = at(record_.frames, frame, "joint_state");
         int column = 2;
         for (std::vector<double>* values : {&f.joint_position, &f.joint_velocity, &f.joint_effort}) {
           take_values(row, column, part_in(*values, part, kJointsARow, "joint_state"), "joint_state");
           column += static_cast<int>(kJointsARow);
         }
       });
  each("frame, hand, " + std::string(kPoseColumns) +
           ", linear_x, linear_y, linear_z, angular_x, angular_y, angular_z, opening, touch_1, touch_2",
       "hand_state", "frame, hand", [&](sql::Statement& row) {
         std::int64_t frame = 0, hand = 0;
         row.read(frame, hand);
         HandRecord& h = at(at(record_.frames, frame, "hand_state").hands, hand, "hand_state");
         int column = 2;
         const auto take = [&](auto& values) {
           for (double& value : values) value = known_or_nan(row, column++);
         };
         take(h.tip.position), take(h.tip.quaternion), take(h.twist);
         h.opening = known_or_nan(row, column++);
         take(h.touch);
       });
  read_poses();
}

// Rows are there where a pose changed, by thing and frame: each is carried forward to the next one of its thing.
template <typename Place>
void EpisodeReader::read_track(const std::string& thing, const std::string& table, std::size_t things,
                               const Place& place) {
  std::string columns = thing;
  columns.append(", frame, ").append(kPoseColumns);
  std::int64_t last_thing = -1, next_frame = 0;
  Pose last;
  const auto carry_to = [&](std::size_t end) {
    for (auto i = static_cast<std::size_t>(next_frame); last_thing >= 0 && i < end; ++i)
      place(record_.frames[i])[static_cast<std::size_t>(last_thing)] = last;
  };
  each(columns, table, thing + ", frame", [&](sql::Statement& row) {
    std::int64_t which = 0, frame = 0;
    Pose pose;
    row.read(which, frame, pose);
    at(record_.frames, frame, table);
    if (which < 0 || which >= static_cast<std::int64_t>(things)) damaged(table);
    carry_to(which == last_thing ? static_cast<std::size_t>(frame) : record_.frames.size());
    last_thing = which, next_frame = frame, last = pose;
  });
  carry_to(record_.frames.size());
}

void EpisodeReader::read_poses() {
  read_track("posed", "object_state", record_.scene.posed.size(),
             [](FrameRecord& frame) -> std::vector<Pose>& { return frame.object_pose; });
  read_track("camera", "camera_pose", record_.scene.cameras.size(), [this](FrameRecord& frame) -> std::vector<Pose>& {
    frame.camera_pose.resize(record_.scene.cameras.size());
    return frame.camera_pose;
  });
}

void EpisodeReader::read_actions() {
  const std::vector<ActionChannel> channels = read_action_channels();
  each("frame, part, " + numbered("value", kChannelsARow), "action", "frame, part", [&](sql::Statement& row) {
    std::int64_t frame = 0;
    std::size_t part = 0;
    row.read(frame, part);
    std::optional<ActionRecord>& action = at(record_.frames, frame, "action").action;
    if (!action) action.emplace();
    if (record_.real && part == 0) action->gripper = std::nan("");  // until it is read
    each_channel(row, part, channels, [&](const ActionChannel& channel, double value) {
      if (channel.space == "joint_position") action->joint_position.push_back(value);
      if (channel.space == "gripper") action->gripper = value;
      if (channel.space != "tool_pose") return;
      if (channel.component > 6) damaged("action_channel");
      auto& [position, quaternion] = action->tool_pose;
      (channel.component < 3 ? position.at(channel.component) : quaternion.at(channel.component - 3)) = value;
    });
  });
}

std::vector<ActionChannel> EpisodeReader::read_action_channels() {
  std::vector<ActionChannel> channels;
  each("space, component", "action_channel", "ordinal", [&](sql::Statement& row) {
    std::int64_t component = 0;
    row.read(channels.emplace_back().space, component);
    if (component < 0) damaged("action_channel");
    channels.back().component = static_cast<std::size_t>(component);
  });
  return channels;
}

void EpisodeReader::read_agent_actions() {
  const auto numbers_in = [this](const std::string& text) {
    auto numbers = from_json_numbers(text);
    if (!numbers) damaged("agent_action");
    return std::move(*numbers);
  };
  each(
      "frame, end_frame, space, numbers, gripper, coalesce(reference, 'world'), coalesce(controller, ''), most_frames, "
      "coalesce(skill, ''), arguments, parameters, coalesce(segment, -1), reward, terminated, truncated",
      "agent_action", "ordinal", [&](sql::Statement& row) {
        AskedAction& one = record_.agent_actions.emplace_back();
        AgentAction& asked = one.asked;
        std::string numbers, arguments, parameters;
        row.read(one.first_frame, one.end_frame, asked.space, numbers, asked.gripper, asked.frame, asked.controller,
                 asked.frames, asked.skill, arguments, parameters, one.segment, one.reward, one.terminated,
                 one.truncated);
        asked.values = numbers_in(numbers);
        asked.arguments = from_json_list(database_, arguments);
        if (parameters == "{}") return;
        sql::Statement items(database_, "SELECT key, value FROM json_each(?1) ORDER BY id");
        for (items.start(parameters); items.step();) {
          std::string values;
          items.read(asked.parameters.emplace_back().name, values);
          asked.parameters.back().values = numbers_in(values);
        }
      });
}

void EpisodeReader::read_commands() {
  each("step, kind, payload, robot", "command", "ordinal", [&](sql::Statement& row) {
    Command& command = record_.commands.emplace_back();
    std::string kind, payload;
    int robot = 0;
    row.read(command.step, kind, payload, robot);
    command.operation = operation_from_bytes(kind, payload);
    set_robot(command.operation, robot);
  });
}

EpisodeRecord Catalogue::read_episode(std::int64_t id) const {
  EpisodeRecord episode = EpisodeReader(impl_->database, id).read();
  check_numbers(episode, impl_->database.path(), id);
  return episode;
}

}  // namespace stampede
