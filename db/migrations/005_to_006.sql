-- changes segment attempt segment_parameter command action_channel episode fact segment_effect
-- Segments and undone tries share a table, reasons and action spaces are open lists, a command names its robot, and
-- what instance masks show is counted (count_visible.cpp). Facts and effects change not: to read, they want indexes.
CREATE TABLE reason (
  name TEXT NOT NULL PRIMARY KEY
) STRICT, WITHOUT ROWID;

INSERT INTO reason (name)
VALUES ('none'), ('no_plan'), ('no_path'), ('no_grasp'), ('no_placement'), ('unreachable'), ('dropped'),
       ('grasp_missed'), ('timeout'), ('effect_mismatch'), ('precondition_false'), ('out_of_order'), ('goal_false'),
       ('goal_unstable'), ('init_impossible'), ('failed_by_task'), ('tracking_error'), ('start_in_collision'),
       ('stuck'), ('script_error'), ('budget'), ('interrupted');

CREATE TEMP TABLE moved AS SELECT * FROM episode;
DROP TABLE episode;
CREATE TABLE episode (
  id INTEGER PRIMARY KEY,
  key TEXT NOT NULL UNIQUE,
  task TEXT NOT NULL,
  world TEXT NOT NULL,
  variation TEXT,
  seed INTEGER,
  split TEXT NOT NULL CHECK (split IN ('train', 'test')),
  outcome TEXT NOT NULL CHECK (outcome IN ('success', 'failure')),
  reason TEXT NOT NULL REFERENCES reason (name),
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

INSERT INTO episode
 (id, key, task, world, variation, seed, split, outcome, reason, detail, beside_goal, frames, steps,
  duration_s, physics_hz, frame_hz, draws, state_hash, source, scene, engine_run)
SELECT id, key, task, world, variation, seed, split, outcome, reason, detail, beside_goal, frames, steps,
  duration_s, physics_hz, frame_hz, draws, state_hash, source, scene, engine_run
FROM temp.moved;
DROP TABLE temp.moved;

CREATE TEMP TABLE moved AS
SELECT s.episode, 0 AS undone, s.ordinal, NULL AS was_ordinal, NULL AS before_segment,
       (SELECT count(*) FROM attempt a
        WHERE a.episode = s.episode AND a.before_segment = s.ordinal AND a.kind = s.kind AND a.skill = s.skill) + 1
         AS try_number,
       kind, parent, robot, skill, case_name, arg1, arg2, arg3, arg4, arguments,
       controller, start_step, end_step, first_frame, end_frame, outcome, reason, detail, precondition_held, effect_held,
       missing_effects, forgotten, label, labelled_by
FROM segment s
UNION ALL
SELECT episode, 1, ordinal, segment_ordinal, before_segment, try_number,
       kind, parent, robot, skill, case_name, arg1, arg2, arg3, arg4, arguments,
       controller, start_step, end_step, first_frame, end_frame, outcome, reason, detail, precondition_held, effect_held,
       missing_effects, forgotten, label, labelled_by
FROM attempt;
DROP TABLE segment;
DROP TABLE attempt;
CREATE TABLE segment (
  episode INTEGER NOT NULL REFERENCES episode (id),
  undone INTEGER NOT NULL CHECK (undone IN (0, 1)),

  ordinal INTEGER NOT NULL,
  was_ordinal INTEGER,
  before_segment INTEGER,
  try_number INTEGER NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('subgoal', 'skill', 'motion', 'control')),
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
  reason TEXT NOT NULL REFERENCES reason (name),
  detail TEXT NOT NULL,
  precondition_held INTEGER CHECK (precondition_held IN (0, 1)),
  effect_held INTEGER CHECK (effect_held IN (0, 1)),
  missing_effects TEXT NOT NULL,
  forgotten TEXT NOT NULL,
  label TEXT NOT NULL,
  labelled_by TEXT NOT NULL CHECK (labelled_by IN ('simulator', 'person', 'model')),
  CHECK (start_step <= end_step AND first_frame <= end_frame),
  CHECK ((was_ordinal IS NOT NULL) = undone AND (before_segment IS NOT NULL) = undone),
  PRIMARY KEY (episode, undone, ordinal)
) STRICT, WITHOUT ROWID;

INSERT INTO segment
 (episode, undone, ordinal, was_ordinal, before_segment, try_number, kind, parent, robot, skill, case_name,
  arg1, arg2, arg3, arg4, arguments, controller, start_step, end_step, first_frame, end_frame, outcome,
  reason, detail, precondition_held, effect_held, missing_effects, forgotten, label, labelled_by)
SELECT episode, undone, ordinal, was_ordinal, before_segment, try_number, kind, parent, robot, skill, case_name,
  arg1, arg2, arg3, arg4, arguments, controller, start_step, end_step, first_frame, end_frame, outcome,
  reason, detail, precondition_held, effect_held, missing_effects, forgotten, label, labelled_by
FROM temp.moved;
DROP TABLE temp.moved;

CREATE TEMP TABLE moved AS SELECT * FROM segment_parameter;
DROP TABLE segment_parameter;
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
  chosen_by TEXT NOT NULL CHECK (chosen_by IN ('default', 'stream', 'planner', 'agent', 'policy', 'task', 'caller')),
  PRIMARY KEY (episode, undone, segment, ordinal, component)
) STRICT, WITHOUT ROWID;

INSERT INTO segment_parameter
 (episode, undone, segment, ordinal, component, name, value, text, unit, frame, chosen_by)
SELECT episode, undone, segment, ordinal, component, name, value, text, unit, frame, chosen_by
FROM temp.moved;
DROP TABLE temp.moved;

ALTER TABLE command ADD COLUMN robot INTEGER NOT NULL DEFAULT 0;

CREATE TEMP TABLE moved AS SELECT * FROM action_channel;
DROP TABLE action_channel;
CREATE TABLE action_channel (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  space TEXT NOT NULL,
  component INTEGER NOT NULL,
  name TEXT NOT NULL,
  unit TEXT NOT NULL,
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;

INSERT INTO action_channel (episode, ordinal, space, component, name, unit)
SELECT episode, ordinal, space, component, name, unit
FROM temp.moved;
DROP TABLE temp.moved;

CREATE TABLE mask_pixels (
  episode INTEGER NOT NULL,
  frame INTEGER NOT NULL,
  camera INTEGER NOT NULL,
  instance INTEGER NOT NULL,
  pixels INTEGER NOT NULL CHECK (pixels > 0),
  PRIMARY KEY (episode, frame, camera, instance),
  FOREIGN KEY (episode, instance) REFERENCES mask (episode, instance)
) STRICT, WITHOUT ROWID;
