// The statements that fill the tables.
#include "db/catalogue_impl.h"
#include "db/episode_writer.h"
#include "db/schema.h"

namespace stampede {
namespace {

// Of (episode, body, part). An object's parts have objects, by which they are named; those of the robot, which is no
// object, have the first mask numbers, in order.
constexpr const char* kMountLink =
    "SELECT name FROM object WHERE episode = ?1 AND body = ?2 AND part = ?3 AND kind IN ('body', 'part') UNION ALL "
    "SELECT name FROM mask WHERE episode = ?1 AND instance = ?3 + 1 AND substr(name, 1, length(?2) + 1) = ?2 || '.' "
    "AND NOT EXISTS (SELECT 1 FROM object WHERE episode = ?1 AND body = ?2 AND kind = 'body')";

}  // namespace

// Columns are named, so that a table may get another one or another order.
sql::Statement EpisodeWriter::insert(const std::string& table, const std::string& columns,
                                     const std::string& ending) const {
  std::string text = "INSERT INTO ";
  text.append(table).append(" (").append(columns).append(") VALUES (?");
  for (const char c : columns)
    if (c == ',') text += ",?";
  text.append(")").append(ending);
  return {database_, text, true};
}

EpisodeWriter::EpisodeWriter(const sql::Database& database) : database_(database) {
  prepare_shared();
  prepare_scene();
  prepare_frames();
  prepare_labels();
  stored_image_ = {database_, "SELECT data FROM image WHERE episode = ?1 AND frame = ?2 AND camera = ?3 AND kind = ?4",
                   true};
  mount_link_ = {database_, kMountLink, true};
}

void EpisodeWriter::prepare_shared() {
  const std::string once = " ON CONFLICT DO NOTHING";  // what many episodes share, keyed by hash or by name
  definition_ = insert("definition", "kind, name, hash, path, source", once);
  engine_run_ = insert("engine_run", "hash, engine_version, numerics, options", once);
  engine_run_definition_ = insert("engine_run_definition", "engine_run, kind, name, hash", once);
  predicate_ = insert("predicate", "engine_run, name, kind", once);
  variation_ = insert("variation", "task, variation", once);
  variation_axis_ = insert("variation_axis", "task, variation, axis, value", once);
  scene_ = insert("scene", "hash, document", once);
  asset_ = insert("asset", "hash, body", once);
  text_store_ = insert("text_store", "hash, body", once);
}

void EpisodeWriter::prepare_scene() {
  episode_ = insert("episode",
                    "id, key, task, world, variation, seed, split, outcome, reason, detail, beside_goal, frames, "
                    "steps, duration_s, physics_hz, frame_hz, draws, state_hash, source, scene, engine_run");
  timing_ = insert("timing", "episode, wall_s, physics_wall_s");
  object_ = insert("object", "episode, ordinal, name, kind, class, type, body, part, size_x, size_y, size_z, mask_id");
  object_trait_ = insert("object_trait", "episode, object, ordinal, trait");
  object_attribute_ = insert("object_attribute", "episode, object, name, value");
  posed_ = insert("posed", "episode, ordinal, name");
  joint_ = insert("joint", "episode, ordinal, name, body, part, kind, unit, lower, upper, driven");
  hand_ = insert("hand", "episode, ordinal, name");
  camera_ = insert("camera",
                   "episode, ordinal, name, width, height, focal_x, focal_y, centre_x, centre_y, k1, k2, p1, p2, "
                   "k3, near_m, far_m, mount_body, mount_part, mount_link, vertical_fov_rad, mount_matrix, x, y, z, "
                   "qx, qy, qz, qw");
}

void EpisodeWriter::prepare_frames() {
  frame_ = insert("frame",
                  "episode, frame, step, time_s, reward, done, skill_segment, motion_segment, "
                  "subgoal_segment, motion, subgoal");
  joint_state_ = insert("joint_state", "episode, frame, part, " + numbered("position", kJointsARow) + ", " +
                                           numbered("velocity", kJointsARow) + ", " + numbered("effort", kJointsARow));
  hand_state_ = insert("hand_state",
                       "episode, frame, hand, x, y, z, qx, qy, qz, qw, linear_x, linear_y, linear_z, angular_x, "
                       "angular_y, angular_z, opening, touch_1, touch_2");
  object_state_ = insert("object_state", "episode, posed, frame, x, y, z, qx, qy, qz, qw");
  camera_pose_ = insert("camera_pose", "episode, camera, frame, x, y, z, qx, qy, qz, qw");
  action_channel_ = insert("action_channel", "episode, ordinal, space, component, name, unit");
  action_ = insert("action", "episode, frame, part, " + numbered("value", kChannelsARow));
  agent_action_ = insert("agent_action",
                         "episode, ordinal, frame, end_frame, space, numbers, gripper, reference, controller, "
                         "most_frames, skill, arguments, parameters, segment, reward, terminated, truncated");
  command_ = insert("command", "episode, ordinal, step, kind, payload, robot");
  channel_ = insert("channel", "episode, ordinal, name, unit, rate_hz");
  component_ = insert("channel_component", "episode, channel, ordinal, name");
  sample_ = insert("sample", "episode, channel, ordinal, part, step, " + numbered("value", kComponentsARow));
}

void EpisodeWriter::prepare_labels() {
  segment_ = insert("segment",
                    "episode, undone, ordinal, was_ordinal, before_segment, try_number, kind, parent, robot, skill, "
                    "case_name, arg1, arg2, arg3, arg4, arguments, controller, start_step, end_step, first_frame, "
                    "end_frame, outcome, reason, detail, precondition_held, effect_held, missing_effects, forgotten, "
                    "searched_for, label, labelled_by");
  parameter_ = insert("segment_parameter",
                      "episode, undone, segment, ordinal, component, name, value, text, unit, frame, chosen_by");
  effect_ =
      insert("segment_effect", "episode, undone, segment, ordinal, negated, predicate, arg1, arg2, arg3, arg4, fact");
  precondition_ = insert("segment_precondition",
                         "episode, undone, segment, ordinal, choice, negated, predicate, arg1, arg2, arg3, arg4, fact, "
                         "held");
  effects_held_ = {database_, derived_sql("effects_held") + " AND d.episode = ?1", true};
  undeclared_ = {database_,
                 "INSERT INTO undeclared_change (episode, segment, fact, negated) SELECT * FROM (" +
                     derived_sql("undeclared_change") + ") WHERE episode = ?1",
                 true};
  via_ = insert("via",
                "episode, ordinal, segment, name, x, y, z, qx, qy, qz, qw, passed_x, passed_y, passed_z, "
                "passed_qx, passed_qy, passed_qz, passed_qw, step, speed, tool_speed");
  fact_ = insert("fact",
                 "episode, ordinal, predicate, arg1, arg2, arg3, arg4, fact, start_step, end_step, first_frame, "
                 "end_frame, open_start, open_end, observed, margin, labelled_by");
  observed_fact_ =
      insert("observed_fact",
             "episode, ordinal, predicate, arg1, arg2, arg3, arg4, fact, start_step, end_step, first_frame, "
             "end_frame, open_start, open_end");
  contact_ =
      insert("contact", "episode, ordinal, object_a, part_a, object_b, part_b, first_frame, end_frame, peak_force");
  grasp_ = insert("grasp", "episode, ordinal, segment, object, x, y, z, qx, qy, qz, qw, width, held");
  language_ = insert("language", "episode, ordinal, level, segment, text, source, grain, model");
  document_ = insert("document", "episode, ordinal, kind, text");
  verdict_ = insert("verdict", "episode, dialect, theirs, ours, disagreements");
  keyframe_ = insert("keyframe", "episode, method, frame");
  mask_ = insert("mask", "episode, instance, name, object, class, semantic, colour");
  image_ = insert("image", "episode, frame, camera, kind, width, height, data");
  stream_ = insert("stream",
                   "episode, ordinal, kind, name, file, clock, offset_s, drift_ppm, reference_s, origin_s, rate_hz, "
                   "readings, longest_gap_s, missing, rule");
  image_time_ = insert("image_time", "episode, frame, camera, kind, time_s");
  visible_ = insert("mask_pixels", "episode, frame, camera, instance, pixels");
}

}  // namespace stampede
