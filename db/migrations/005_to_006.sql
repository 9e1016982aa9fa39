-- changes segment attempt segment_parameter command action_channel episode fact segment_effect mask object object_attribute channel
-- Segments and undone tries share a table, reasons and action spaces are open lists, a command names its robot, what
-- instance masks show is counted (count_visible.cpp), and rows of frames are wide. What preconditions were tested and
-- what agents asked for, no earlier release wrote: there are no rows. Facts and objects change not: to read, they want indexes, or are asked here.
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
  searched_for TEXT NOT NULL,
  label TEXT NOT NULL,
  labelled_by TEXT NOT NULL CHECK (labelled_by IN ('simulator', 'person', 'model')),
  CHECK (start_step <= end_step AND first_frame <= end_frame),
  CHECK ((was_ordinal IS NOT NULL) = undone AND (before_segment IS NOT NULL) = undone),
  PRIMARY KEY (episode, undone, ordinal)
) STRICT, WITHOUT ROWID;

INSERT INTO segment
 (episode, undone, ordinal, was_ordinal, before_segment, try_number, kind, parent, robot, skill, case_name,
  arg1, arg2, arg3, arg4, arguments, controller, start_step, end_step, first_frame, end_frame, outcome,
  reason, detail, precondition_held, effect_held, missing_effects, forgotten, searched_for, label,
  labelled_by)
SELECT episode, undone, ordinal, was_ordinal, before_segment, try_number, kind, parent, robot, skill, case_name,
  arg1, arg2, arg3, arg4, arguments, controller, start_step, end_step, first_frame, end_frame, outcome,
  reason, detail, precondition_held, effect_held, missing_effects, forgotten, '[]', label, labelled_by
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

CREATE TABLE segment_precondition (
  episode INTEGER NOT NULL REFERENCES episode (id),
  undone INTEGER NOT NULL CHECK (undone IN (0, 1)),
  segment INTEGER NOT NULL,
  ordinal INTEGER NOT NULL,
  choice INTEGER,
  negated INTEGER NOT NULL CHECK (negated IN (0, 1)),
  predicate TEXT NOT NULL,
  arg1 TEXT,
  arg2 TEXT,
  arg3 TEXT,
  arg4 TEXT,
  fact TEXT NOT NULL,
  held INTEGER NOT NULL CHECK (held IN (0, 1)),
  PRIMARY KEY (episode, undone, segment, ordinal)
) STRICT, WITHOUT ROWID;

CREATE TABLE agent_action (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  frame INTEGER NOT NULL,
  end_frame INTEGER NOT NULL,
  space TEXT NOT NULL,
  numbers TEXT NOT NULL,
  gripper REAL,
  reference TEXT,
  controller TEXT,
  most_frames INTEGER NOT NULL,
  skill TEXT,
  arguments TEXT NOT NULL,
  parameters TEXT NOT NULL,
  segment INTEGER,
  reward REAL,
  terminated INTEGER NOT NULL CHECK (terminated IN (0, 1)),
  truncated INTEGER NOT NULL CHECK (truncated IN (0, 1)),
  CHECK (frame <= end_frame),
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;

ALTER TABLE segment_effect ADD COLUMN held INTEGER CHECK (held IN (0, 1));

ALTER TABLE mask ADD COLUMN colour TEXT;
UPDATE mask SET colour = (SELECT a.value FROM object o
                          JOIN object_attribute a ON a.episode = o.episode AND a.object = o.ordinal
                          WHERE o.episode = mask.episode AND o.name = mask.object AND a.name = 'colour');

CREATE TABLE channel_component (
  episode INTEGER NOT NULL,
  channel INTEGER NOT NULL,
  ordinal INTEGER NOT NULL,
  name TEXT NOT NULL,
  PRIMARY KEY (episode, channel, ordinal),
  FOREIGN KEY (episode, channel) REFERENCES channel (episode, ordinal)
) STRICT, WITHOUT ROWID;

INSERT INTO channel_component (episode, channel, ordinal, name)
SELECT c.episode, c.ordinal, j.key, j.value
FROM channel c, json_each(c.components) j;
ALTER TABLE channel DROP COLUMN components;

-- in place: large tables in their new shape, a row of it from the first of those that it is made of
CREATE TEMP VIEW frame AS
SELECT episode, frame, step, time_s, reward, done, skill_segment, motion_segment, subgoal_segment,
       (SELECT skill FROM segment WHERE (episode, undone, ordinal) = (f.episode, 0, f.motion_segment)) AS motion,
       (SELECT skill FROM segment WHERE (episode, undone, ordinal) = (f.episode, 0, f.subgoal_segment)) AS subgoal
FROM (SELECT o.episode, o.frame, o.step, o.time_s, o.reward, o.done, o.skill_segment, o.motion_segment,
             (SELECT max(g.ordinal) FROM segment g WHERE g.episode = o.episode AND g.undone = 0
                AND g.kind = 'subgoal' AND g.first_frame <= o.frame AND o.frame < g.end_frame) AS subgoal_segment
      FROM old.frame o) f;
CREATE TEMP VIEW joint_state AS
SELECT s.episode, s.frame, s.joint / 12 AS part,
       s.position AS position_0,
       (SELECT position FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 1)) AS position_1,
       (SELECT position FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 2)) AS position_2,
       (SELECT position FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 3)) AS position_3,
       (SELECT position FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 4)) AS position_4,
       (SELECT position FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 5)) AS position_5,
       (SELECT position FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 6)) AS position_6,
       (SELECT position FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 7)) AS position_7,
       (SELECT position FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 8)) AS position_8,
       (SELECT position FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 9)) AS position_9,
       (SELECT position FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 10)) AS position_10,
       (SELECT position FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 11)) AS position_11,
       s.velocity AS velocity_0,
       (SELECT velocity FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 1)) AS velocity_1,
       (SELECT velocity FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 2)) AS velocity_2,
       (SELECT velocity FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 3)) AS velocity_3,
       (SELECT velocity FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 4)) AS velocity_4,
       (SELECT velocity FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 5)) AS velocity_5,
       (SELECT velocity FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 6)) AS velocity_6,
       (SELECT velocity FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 7)) AS velocity_7,
       (SELECT velocity FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 8)) AS velocity_8,
       (SELECT velocity FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 9)) AS velocity_9,
       (SELECT velocity FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 10)) AS velocity_10,
       (SELECT velocity FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 11)) AS velocity_11,
       s.effort AS effort_0,
       (SELECT effort FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 1)) AS effort_1,
       (SELECT effort FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 2)) AS effort_2,
       (SELECT effort FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 3)) AS effort_3,
       (SELECT effort FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 4)) AS effort_4,
       (SELECT effort FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 5)) AS effort_5,
       (SELECT effort FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 6)) AS effort_6,
       (SELECT effort FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 7)) AS effort_7,
       (SELECT effort FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 8)) AS effort_8,
       (SELECT effort FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 9)) AS effort_9,
       (SELECT effort FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 10)) AS effort_10,
       (SELECT effort FROM old.joint_state WHERE (episode, frame, joint) = (s.episode, s.frame, s.joint + 11)) AS effort_11
FROM old.joint_state s
WHERE s.joint % 12 = 0;
CREATE TEMP VIEW action AS
SELECT s.episode, s.frame, s.channel / 16 AS part,
       s.value AS value_0,
       (SELECT value FROM old.action WHERE (episode, frame, channel) = (s.episode, s.frame, s.channel + 1)) AS value_1,
       (SELECT value FROM old.action WHERE (episode, frame, channel) = (s.episode, s.frame, s.channel + 2)) AS value_2,
       (SELECT value FROM old.action WHERE (episode, frame, channel) = (s.episode, s.frame, s.channel + 3)) AS value_3,
       (SELECT value FROM old.action WHERE (episode, frame, channel) = (s.episode, s.frame, s.channel + 4)) AS value_4,
       (SELECT value FROM old.action WHERE (episode, frame, channel) = (s.episode, s.frame, s.channel + 5)) AS value_5,
       (SELECT value FROM old.action WHERE (episode, frame, channel) = (s.episode, s.frame, s.channel + 6)) AS value_6,
       (SELECT value FROM old.action WHERE (episode, frame, channel) = (s.episode, s.frame, s.channel + 7)) AS value_7,
       (SELECT value FROM old.action WHERE (episode, frame, channel) = (s.episode, s.frame, s.channel + 8)) AS value_8,
       (SELECT value FROM old.action WHERE (episode, frame, channel) = (s.episode, s.frame, s.channel + 9)) AS value_9,
       (SELECT value FROM old.action WHERE (episode, frame, channel) = (s.episode, s.frame, s.channel + 10)) AS value_10,
       (SELECT value FROM old.action WHERE (episode, frame, channel) = (s.episode, s.frame, s.channel + 11)) AS value_11,
       (SELECT value FROM old.action WHERE (episode, frame, channel) = (s.episode, s.frame, s.channel + 12)) AS value_12,
       (SELECT value FROM old.action WHERE (episode, frame, channel) = (s.episode, s.frame, s.channel + 13)) AS value_13,
       (SELECT value FROM old.action WHERE (episode, frame, channel) = (s.episode, s.frame, s.channel + 14)) AS value_14,
       (SELECT value FROM old.action WHERE (episode, frame, channel) = (s.episode, s.frame, s.channel + 15)) AS value_15
FROM old.action s
WHERE s.channel % 16 = 0;
CREATE TEMP VIEW sample AS
SELECT s.episode, s.channel, s.ordinal, s.component / 8 AS part, s.step,
       s.value AS value_0,
       (SELECT value FROM old.sample WHERE (episode, channel, ordinal, component) = (s.episode, s.channel, s.ordinal, s.component + 1)) AS value_1,
       (SELECT value FROM old.sample WHERE (episode, channel, ordinal, component) = (s.episode, s.channel, s.ordinal, s.component + 2)) AS value_2,
       (SELECT value FROM old.sample WHERE (episode, channel, ordinal, component) = (s.episode, s.channel, s.ordinal, s.component + 3)) AS value_3,
       (SELECT value FROM old.sample WHERE (episode, channel, ordinal, component) = (s.episode, s.channel, s.ordinal, s.component + 4)) AS value_4,
       (SELECT value FROM old.sample WHERE (episode, channel, ordinal, component) = (s.episode, s.channel, s.ordinal, s.component + 5)) AS value_5,
       (SELECT value FROM old.sample WHERE (episode, channel, ordinal, component) = (s.episode, s.channel, s.ordinal, s.component + 6)) AS value_6,
       (SELECT value FROM old.sample WHERE (episode, channel, ordinal, component) = (s.episode, s.channel, s.ordinal, s.component + 7)) AS value_7
FROM old.sample s
WHERE s.component % 8 = 0;

-- to write: the same as tables
CREATE TABLE main.made (
  episode INTEGER NOT NULL REFERENCES episode (id),
  frame INTEGER NOT NULL,
  step INTEGER NOT NULL,
  time_s REAL NOT NULL,
  reward REAL NOT NULL,
  done INTEGER NOT NULL CHECK (done IN (0, 1)),
  skill_segment INTEGER,
  motion_segment INTEGER,
  subgoal_segment INTEGER,
  motion TEXT,
  subgoal TEXT,
  PRIMARY KEY (episode, frame)
) STRICT, WITHOUT ROWID;

INSERT INTO main.made SELECT * FROM temp.frame;
DROP VIEW temp.frame;
DROP TABLE main.frame;
ALTER TABLE main.made RENAME TO frame;

CREATE TABLE main.made (
  episode INTEGER NOT NULL REFERENCES episode (id),
  frame INTEGER NOT NULL,
  part INTEGER NOT NULL,
  position_0 REAL, position_1 REAL, position_2 REAL, position_3 REAL,
  position_4 REAL, position_5 REAL, position_6 REAL, position_7 REAL,
  position_8 REAL, position_9 REAL, position_10 REAL, position_11 REAL,
  velocity_0 REAL, velocity_1 REAL, velocity_2 REAL, velocity_3 REAL,
  velocity_4 REAL, velocity_5 REAL, velocity_6 REAL, velocity_7 REAL,
  velocity_8 REAL, velocity_9 REAL, velocity_10 REAL, velocity_11 REAL,
  effort_0 REAL, effort_1 REAL, effort_2 REAL, effort_3 REAL,
  effort_4 REAL, effort_5 REAL, effort_6 REAL, effort_7 REAL,
  effort_8 REAL, effort_9 REAL, effort_10 REAL, effort_11 REAL,
  PRIMARY KEY (episode, frame, part)
) STRICT, WITHOUT ROWID;

INSERT INTO main.made SELECT * FROM temp.joint_state;
DROP VIEW temp.joint_state;
DROP TABLE main.joint_state;
ALTER TABLE main.made RENAME TO joint_state;

CREATE TABLE main.made (
  episode INTEGER NOT NULL REFERENCES episode (id),
  frame INTEGER NOT NULL,
  part INTEGER NOT NULL,
  value_0 REAL, value_1 REAL, value_2 REAL, value_3 REAL,
  value_4 REAL, value_5 REAL, value_6 REAL, value_7 REAL,
  value_8 REAL, value_9 REAL, value_10 REAL, value_11 REAL,
  value_12 REAL, value_13 REAL, value_14 REAL, value_15 REAL,
  PRIMARY KEY (episode, frame, part)
) STRICT, WITHOUT ROWID;

INSERT INTO main.made SELECT * FROM temp.action;
DROP VIEW temp.action;
DROP TABLE main.action;
ALTER TABLE main.made RENAME TO action;

CREATE TABLE main.made (
  episode INTEGER NOT NULL,
  channel INTEGER NOT NULL,
  ordinal INTEGER NOT NULL,
  part INTEGER NOT NULL,
  step INTEGER NOT NULL,
  value_0 REAL, value_1 REAL, value_2 REAL, value_3 REAL,
  value_4 REAL, value_5 REAL, value_6 REAL, value_7 REAL,
  PRIMARY KEY (episode, channel, ordinal, part),
  FOREIGN KEY (episode, channel) REFERENCES channel (episode, ordinal)
) STRICT, WITHOUT ROWID;

INSERT INTO main.made SELECT * FROM temp.sample;
DROP VIEW temp.sample;
DROP TABLE main.sample;
ALTER TABLE main.made RENAME TO sample;

CREATE TABLE undeclared_change (
  episode INTEGER NOT NULL REFERENCES episode (id),
  segment INTEGER NOT NULL,
  fact TEXT NOT NULL,
  negated INTEGER NOT NULL CHECK (negated IN (0, 1)),
  PRIMARY KEY (episode, segment, fact)
) STRICT, WITHOUT ROWID;
