-- What release 5 declared: catalogues of it and of those after it are compared with what follows from this.
CREATE TABLE definition (
  kind TEXT NOT NULL CHECK (kind IN ('task', 'skill', 'predicate', 'object', 'world', 'robot', 'types', 'colours',
                                     'module')),
  name TEXT NOT NULL,
  hash TEXT NOT NULL,
  path TEXT NOT NULL,
  source TEXT NOT NULL,
  PRIMARY KEY (kind, name, hash)
) STRICT, WITHOUT ROWID;
CREATE TABLE engine_run (
  hash TEXT NOT NULL PRIMARY KEY,
  engine_version TEXT NOT NULL,
  numerics TEXT NOT NULL,
  options TEXT NOT NULL
) STRICT, WITHOUT ROWID;
CREATE TABLE engine_run_definition (
  engine_run TEXT NOT NULL REFERENCES engine_run (hash),
  kind TEXT NOT NULL,
  name TEXT NOT NULL,
  hash TEXT NOT NULL,
  PRIMARY KEY (engine_run, kind, name, hash),
  FOREIGN KEY (kind, name, hash) REFERENCES definition (kind, name, hash)
) STRICT, WITHOUT ROWID;
CREATE TABLE predicate (
  engine_run TEXT NOT NULL REFERENCES engine_run (hash),
  name TEXT NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('basic', 'derived', 'fixed')),
  PRIMARY KEY (engine_run, name)
) STRICT, WITHOUT ROWID;
CREATE TABLE variation (
  task TEXT NOT NULL,
  variation TEXT NOT NULL,
  PRIMARY KEY (task, variation)
) STRICT, WITHOUT ROWID;
CREATE TABLE variation_axis (
  task TEXT NOT NULL,
  variation TEXT NOT NULL,
  axis TEXT NOT NULL,
  value TEXT NOT NULL,
  PRIMARY KEY (task, variation, axis),
  FOREIGN KEY (task, variation) REFERENCES variation (task, variation)
) STRICT, WITHOUT ROWID;
CREATE TABLE split (
  name TEXT NOT NULL CHECK (name IN ('train', 'test')),
  task TEXT,
  variation TEXT,
  first_seed INTEGER,
  end_seed INTEGER
) STRICT;
CREATE TABLE scene (
  hash TEXT NOT NULL PRIMARY KEY,
  document TEXT NOT NULL
) STRICT, WITHOUT ROWID;
CREATE TABLE asset (
  hash TEXT NOT NULL PRIMARY KEY,
  body TEXT NOT NULL
) STRICT, WITHOUT ROWID;
CREATE TABLE text_store (
  hash TEXT NOT NULL PRIMARY KEY,
  body TEXT NOT NULL
) STRICT, WITHOUT ROWID;
CREATE TABLE episode (
  id INTEGER PRIMARY KEY,
  key TEXT NOT NULL UNIQUE,
  task TEXT NOT NULL,
  world TEXT NOT NULL,
  variation TEXT,
  seed INTEGER,
  split TEXT NOT NULL CHECK (split IN ('train', 'test')),
  outcome TEXT NOT NULL CHECK (outcome IN ('success', 'failure')),
  reason TEXT NOT NULL CHECK (reason IN (
      'none', 'no_plan', 'no_path', 'no_grasp', 'no_placement', 'unreachable', 'dropped', 'grasp_missed',
      'timeout', 'effect_mismatch', 'precondition_false', 'out_of_order', 'goal_false', 'goal_unstable',
      'init_impossible', 'failed_by_task', 'tracking_error', 'start_in_collision', 'stuck', 'script_error',
      'budget', 'interrupted')),
  detail TEXT NOT NULL,
  beside_goal TEXT NOT NULL,
  frames INTEGER NOT NULL,
  steps INTEGER NOT NULL,
  duration_s REAL NOT NULL,
  physics_hz INTEGER NOT NULL,
  frame_hz INTEGER NOT NULL,
  draws REAL NOT NULL,
  state_hash TEXT,
  source TEXT NOT NULL CHECK (source IN ('sim', 'real')),
  scene TEXT REFERENCES scene (hash),
  engine_run TEXT NOT NULL REFERENCES engine_run (hash),
  FOREIGN KEY (task, variation) REFERENCES variation (task, variation),
  CHECK ((source = 'real') = (variation IS NULL)),
  CHECK ((source = 'real') = (seed IS NULL)),
  CHECK ((source = 'real') = (state_hash IS NULL)),
  CHECK (seed < 1000000 OR split = 'test'),
  CHECK ((outcome = 'success') = (reason = 'none'))
) STRICT;
CREATE TABLE timing (
  episode INTEGER PRIMARY KEY REFERENCES episode (id),
  wall_s REAL NOT NULL,
  physics_wall_s REAL NOT NULL
) STRICT;
CREATE TABLE object (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  name TEXT NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('body', 'part', 'region', 'hand')),
  class TEXT NOT NULL,
  type TEXT NOT NULL,
  body TEXT NOT NULL,
  part INTEGER NOT NULL,
  size_x REAL NOT NULL,
  size_y REAL NOT NULL,
  size_z REAL NOT NULL,
  mask_id INTEGER NOT NULL,
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE object_trait (
  episode INTEGER NOT NULL,
  object INTEGER NOT NULL,
  ordinal INTEGER NOT NULL,
  trait TEXT NOT NULL,
  PRIMARY KEY (episode, object, ordinal),
  FOREIGN KEY (episode, object) REFERENCES object (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE object_attribute (
  episode INTEGER NOT NULL,
  object INTEGER NOT NULL,
  name TEXT NOT NULL,
  value ANY NOT NULL,
  PRIMARY KEY (episode, object, name, value),
  FOREIGN KEY (episode, object) REFERENCES object (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE posed (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  name TEXT NOT NULL,
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE joint (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  name TEXT NOT NULL,
  body INTEGER NOT NULL,
  part INTEGER NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('fixed', 'hinge', 'slider')),
  unit TEXT NOT NULL,
  lower REAL NOT NULL,
  upper REAL NOT NULL,
  driven INTEGER NOT NULL CHECK (driven IN (0, 1)),
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE hand (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  name TEXT NOT NULL,
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE camera (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  name TEXT NOT NULL,
  width INTEGER NOT NULL,
  height INTEGER NOT NULL,
  focal_x REAL NOT NULL CHECK (focal_x > 0),
  focal_y REAL NOT NULL CHECK (focal_y > 0),
  centre_x REAL NOT NULL,
  centre_y REAL NOT NULL,
  k1 REAL NOT NULL,
  k2 REAL NOT NULL,
  p1 REAL NOT NULL,
  p2 REAL NOT NULL,
  k3 REAL NOT NULL,
  near_m REAL NOT NULL,
  far_m REAL NOT NULL,
  mount_body TEXT NOT NULL,
  mount_part INTEGER NOT NULL,
  mount_link TEXT NOT NULL,
  vertical_fov_rad REAL NOT NULL,
  mount_matrix TEXT NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL, qx REAL NOT NULL, qy REAL NOT NULL, qz REAL NOT NULL, qw REAL NOT NULL,
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE frame (
  episode INTEGER NOT NULL REFERENCES episode (id),
  frame INTEGER NOT NULL,
  step INTEGER NOT NULL,
  time_s REAL NOT NULL,
  reward REAL NOT NULL,
  done INTEGER NOT NULL CHECK (done IN (0, 1)),
  skill_segment INTEGER,
  motion_segment INTEGER,
  PRIMARY KEY (episode, frame)
) STRICT, WITHOUT ROWID;
CREATE TABLE joint_state (
  episode INTEGER NOT NULL,
  frame INTEGER NOT NULL,
  joint INTEGER NOT NULL,
  position REAL NOT NULL,
  velocity REAL NOT NULL,
  effort REAL NOT NULL,
  PRIMARY KEY (episode, frame, joint),
  FOREIGN KEY (episode, joint) REFERENCES joint (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE hand_state (
  episode INTEGER NOT NULL,
  frame INTEGER NOT NULL,
  hand INTEGER NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL, qx REAL NOT NULL, qy REAL NOT NULL, qz REAL NOT NULL, qw REAL NOT NULL,
  linear_x REAL NOT NULL, linear_y REAL NOT NULL, linear_z REAL NOT NULL,
  angular_x REAL NOT NULL, angular_y REAL NOT NULL, angular_z REAL NOT NULL,
  opening REAL NOT NULL,
  touch_1 REAL NOT NULL,
  touch_2 REAL NOT NULL,
  PRIMARY KEY (episode, frame, hand),
  FOREIGN KEY (episode, hand) REFERENCES hand (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE object_state (
  episode INTEGER NOT NULL,
  posed INTEGER NOT NULL,
  frame INTEGER NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL, qx REAL NOT NULL, qy REAL NOT NULL, qz REAL NOT NULL, qw REAL NOT NULL,
  PRIMARY KEY (episode, posed, frame),
  FOREIGN KEY (episode, posed) REFERENCES posed (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE camera_pose (
  episode INTEGER NOT NULL,
  camera INTEGER NOT NULL,
  frame INTEGER NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL, qx REAL NOT NULL, qy REAL NOT NULL, qz REAL NOT NULL, qw REAL NOT NULL,
  PRIMARY KEY (episode, camera, frame),
  FOREIGN KEY (episode, camera) REFERENCES camera (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE action_channel (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  space TEXT NOT NULL CHECK (space IN ('joint_position', 'tool_pose', 'gripper')),
  component INTEGER NOT NULL,
  name TEXT NOT NULL,
  unit TEXT NOT NULL,
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE action (
  episode INTEGER NOT NULL,
  frame INTEGER NOT NULL,
  channel INTEGER NOT NULL,
  value REAL NOT NULL,
  PRIMARY KEY (episode, frame, channel),
  FOREIGN KEY (episode, channel) REFERENCES action_channel (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE command (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  step INTEGER NOT NULL,
  kind TEXT NOT NULL,
  payload BLOB NOT NULL,
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE channel (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  name TEXT NOT NULL,
  unit TEXT NOT NULL,
  rate_hz REAL NOT NULL,
  components TEXT NOT NULL,
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE sample (
  episode INTEGER NOT NULL,
  channel INTEGER NOT NULL,
  ordinal INTEGER NOT NULL,
  component INTEGER NOT NULL,
  step INTEGER NOT NULL,
  value REAL NOT NULL,
  PRIMARY KEY (episode, channel, ordinal, component),
  FOREIGN KEY (episode, channel) REFERENCES channel (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE segment (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('subgoal', 'skill', 'motion')),
  parent INTEGER,
  robot TEXT NOT NULL,
  skill TEXT NOT NULL,
  case_name TEXT NOT NULL,
  arg1 TEXT,
  arg2 TEXT,
  arg3 TEXT,
  arg4 TEXT,
  arguments TEXT NOT NULL,
  controller TEXT NOT NULL,
  start_step INTEGER NOT NULL,
  end_step INTEGER NOT NULL,
  first_frame INTEGER NOT NULL,
  end_frame INTEGER NOT NULL,
  outcome TEXT NOT NULL CHECK (outcome IN ('success', 'failure')),
  reason TEXT NOT NULL CHECK (reason IN (
      'none', 'no_plan', 'no_path', 'no_grasp', 'no_placement', 'unreachable', 'dropped', 'grasp_missed',
      'timeout', 'effect_mismatch', 'precondition_false', 'out_of_order', 'goal_false', 'goal_unstable',
      'init_impossible', 'failed_by_task', 'tracking_error', 'start_in_collision', 'stuck', 'script_error',
      'budget', 'interrupted')),
  detail TEXT NOT NULL,
  precondition_held INTEGER CHECK (precondition_held IN (0, 1)),
  effect_held INTEGER CHECK (effect_held IN (0, 1)),
  missing_effects TEXT NOT NULL,
  forgotten TEXT NOT NULL,
  label TEXT NOT NULL,
  labelled_by TEXT NOT NULL CHECK (labelled_by IN ('simulator', 'person', 'model')),
  CHECK (start_step <= end_step AND first_frame <= end_frame),
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE attempt (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  segment_ordinal INTEGER NOT NULL,
  before_segment INTEGER NOT NULL,
  try_number INTEGER NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('subgoal', 'skill', 'motion')),
  parent INTEGER,
  robot TEXT NOT NULL,
  skill TEXT NOT NULL,
  case_name TEXT NOT NULL,
  arg1 TEXT,
  arg2 TEXT,
  arg3 TEXT,
  arg4 TEXT,
  arguments TEXT NOT NULL,
  controller TEXT NOT NULL,
  start_step INTEGER NOT NULL,
  end_step INTEGER NOT NULL,
  first_frame INTEGER NOT NULL,
  end_frame INTEGER NOT NULL,
  outcome TEXT NOT NULL CHECK (outcome IN ('success', 'failure')),
  reason TEXT NOT NULL CHECK (reason IN (
      'none', 'no_plan', 'no_path', 'no_grasp', 'no_placement', 'unreachable', 'dropped', 'grasp_missed',
      'timeout', 'effect_mismatch', 'precondition_false', 'out_of_order', 'goal_false', 'goal_unstable',
      'init_impossible', 'failed_by_task', 'tracking_error', 'start_in_collision', 'stuck', 'script_error',
      'budget', 'interrupted')),
  detail TEXT NOT NULL,
  precondition_held INTEGER CHECK (precondition_held IN (0, 1)),
  effect_held INTEGER CHECK (effect_held IN (0, 1)),
  missing_effects TEXT NOT NULL,
  forgotten TEXT NOT NULL,
  label TEXT NOT NULL,
  labelled_by TEXT NOT NULL CHECK (labelled_by IN ('simulator', 'person', 'model')),
  CHECK (start_step <= end_step AND first_frame <= end_frame),
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE segment_parameter (
  episode INTEGER NOT NULL REFERENCES episode (id),
  undone INTEGER NOT NULL CHECK (undone IN (0, 1)),
  segment INTEGER NOT NULL,
  ordinal INTEGER NOT NULL,
  component INTEGER NOT NULL,
  name TEXT NOT NULL,
  value REAL,
  text TEXT,
  unit TEXT NOT NULL,
  frame TEXT NOT NULL,
  chosen_by TEXT NOT NULL CHECK (chosen_by IN ('default', 'stream', 'planner', 'agent')),
  PRIMARY KEY (episode, undone, segment, ordinal, component)
) STRICT, WITHOUT ROWID;
CREATE TABLE segment_effect (
  episode INTEGER NOT NULL REFERENCES episode (id),
  undone INTEGER NOT NULL CHECK (undone IN (0, 1)),
  segment INTEGER NOT NULL,
  ordinal INTEGER NOT NULL,
  negated INTEGER NOT NULL CHECK (negated IN (0, 1)),
  predicate TEXT NOT NULL,
  arg1 TEXT,
  arg2 TEXT,
  arg3 TEXT,
  arg4 TEXT,
  fact TEXT NOT NULL,
  PRIMARY KEY (episode, undone, segment, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE via (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  segment INTEGER NOT NULL,
  name TEXT NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL, qx REAL NOT NULL, qy REAL NOT NULL, qz REAL NOT NULL, qw REAL NOT NULL,
  passed_x REAL NOT NULL, passed_y REAL NOT NULL, passed_z REAL NOT NULL, passed_qx REAL NOT NULL, passed_qy REAL NOT NULL, passed_qz REAL NOT NULL, passed_qw REAL NOT NULL,
  step INTEGER NOT NULL,
  speed REAL NOT NULL,
  tool_speed REAL NOT NULL,
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE fact (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  predicate TEXT NOT NULL,
  arg1 TEXT,
  arg2 TEXT,
  arg3 TEXT,
  arg4 TEXT,
  fact TEXT NOT NULL,
  start_step INTEGER NOT NULL,
  end_step INTEGER NOT NULL,
  first_frame INTEGER NOT NULL,
  end_frame INTEGER NOT NULL,
  open_start INTEGER NOT NULL CHECK (open_start IN (0, 1)),
  open_end INTEGER NOT NULL CHECK (open_end IN (0, 1)),
  observed INTEGER NOT NULL CHECK (observed IN (0, 1)),
  margin REAL,
  PRIMARY KEY (episode, ordinal),
  CHECK (start_step <= end_step AND first_frame <= end_frame)
) STRICT, WITHOUT ROWID;
CREATE TABLE observed_fact (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  predicate TEXT NOT NULL,
  arg1 TEXT,
  arg2 TEXT,
  arg3 TEXT,
  arg4 TEXT,
  fact TEXT NOT NULL,
  start_step INTEGER NOT NULL,
  end_step INTEGER NOT NULL,
  first_frame INTEGER NOT NULL,
  end_frame INTEGER NOT NULL,
  open_start INTEGER NOT NULL CHECK (open_start IN (0, 1)),
  open_end INTEGER NOT NULL CHECK (open_end IN (0, 1)),
  PRIMARY KEY (episode, ordinal),
  CHECK (start_step <= end_step AND first_frame <= end_frame)
) STRICT, WITHOUT ROWID;
CREATE TABLE contact (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  object_a TEXT NOT NULL,
  part_a TEXT NOT NULL,
  object_b TEXT NOT NULL,
  part_b TEXT NOT NULL,
  first_frame INTEGER NOT NULL,
  end_frame INTEGER NOT NULL,
  peak_force REAL NOT NULL,
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE grasp (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  segment INTEGER NOT NULL,
  object TEXT NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL, qx REAL NOT NULL, qy REAL NOT NULL, qz REAL NOT NULL, qw REAL NOT NULL,
  width REAL NOT NULL,
  held INTEGER NOT NULL CHECK (held IN (0, 1)),
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE language (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  level TEXT NOT NULL CHECK (level IN ('task', 'world', 'skill')),
  segment INTEGER,
  text TEXT NOT NULL,
  source TEXT NOT NULL CHECK (source IN ('template', 'model')),
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE document (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('pddl_domain', 'pddl_problem', 'plan', 'failed_plan', 'ordered_domain',
                                     'ordered_problem', 'bddl_behavior',
                                     'bddl_libero')),
  text TEXT NOT NULL REFERENCES text_store (hash),
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;
CREATE TABLE verdict (
  episode INTEGER NOT NULL REFERENCES episode (id),
  dialect TEXT NOT NULL CHECK (dialect IN ('libero', 'behavior')),
  theirs INTEGER NOT NULL CHECK (theirs IN (0, 1)),
  ours INTEGER NOT NULL CHECK (ours IN (0, 1)),
  disagreements TEXT NOT NULL,
  PRIMARY KEY (episode, dialect)
) STRICT, WITHOUT ROWID;
CREATE TABLE keyframe (
  episode INTEGER NOT NULL REFERENCES episode (id),
  method TEXT NOT NULL,
  frame INTEGER NOT NULL,
  PRIMARY KEY (episode, method, frame)
) STRICT, WITHOUT ROWID;
CREATE TABLE mask (
  episode INTEGER NOT NULL REFERENCES episode (id),
  instance INTEGER NOT NULL CHECK (instance > 0),
  name TEXT NOT NULL,
  object TEXT NOT NULL,
  class TEXT NOT NULL,
  semantic INTEGER NOT NULL CHECK (semantic > 0),
  PRIMARY KEY (episode, instance)
) STRICT, WITHOUT ROWID;
CREATE TABLE image (
  episode INTEGER NOT NULL REFERENCES episode (id),
  frame INTEGER NOT NULL,
  camera INTEGER NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('rgb', 'depth', 'instance', 'semantic', 'points')),
  width INTEGER NOT NULL CHECK (width > 0),
  height INTEGER NOT NULL CHECK (height > 0),
  data BLOB NOT NULL,
  PRIMARY KEY (episode, frame, camera, kind),
  FOREIGN KEY (episode, frame) REFERENCES frame (episode, frame),
  FOREIGN KEY (episode, camera) REFERENCES camera (episode, ordinal)
) STRICT;
CREATE INDEX episode_by_task ON episode (task, variation, seed);
CREATE INDEX segment_by_skill ON segment (skill, kind, outcome);
CREATE INDEX attempt_by_skill ON attempt (skill, kind, outcome);
CREATE INDEX fact_by_predicate ON fact (predicate, arg1, arg2);
