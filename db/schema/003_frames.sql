-- What was observed and commanded. Child rows of a frame carry (episode, frame, which).
CREATE TABLE frame (
  episode INTEGER NOT NULL REFERENCES episode (id),
  frame INTEGER NOT NULL,
  step INTEGER NOT NULL,
  time_s REAL NOT NULL,
  reward REAL,             -- NULL: a real episode
  done INTEGER NOT NULL CHECK (done IN (0, 1)),
  skill_segment INTEGER,   -- innermost segments that run here
  motion_segment INTEGER,
  subgoal_segment INTEGER,
  motion TEXT,             -- names of the two: they would be looked up at every frame
  subgoal TEXT,
  PRIMARY KEY (episode, frame)
) STRICT, WITHOUT ROWID;

CREATE TABLE joint_state (  -- twelve joints a row: joint 12 * part + i is in the columns that end in i
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

CREATE TABLE hand_state (  -- NULL: not known of a real episode
  episode INTEGER NOT NULL,
  frame INTEGER NOT NULL,
  hand INTEGER NOT NULL,
  x REAL, y REAL, z REAL, qx REAL, qy REAL, qz REAL, qw REAL,
  linear_x REAL, linear_y REAL, linear_z REAL,
  angular_x REAL, angular_y REAL, angular_z REAL,
  opening REAL,
  touch_1 REAL,
  touch_2 REAL,
  PRIMARY KEY (episode, frame, hand),
  FOREIGN KEY (episode, hand) REFERENCES hand (episode, ordinal)
) STRICT, WITHOUT ROWID;

CREATE TABLE object_state (  -- a row only where the pose changed
  episode INTEGER NOT NULL,
  posed INTEGER NOT NULL,
  frame INTEGER NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL, qx REAL NOT NULL, qy REAL NOT NULL, qz REAL NOT NULL, qw REAL NOT NULL,
  PRIMARY KEY (episode, posed, frame),
  FOREIGN KEY (episode, posed) REFERENCES posed (episode, ordinal)
) STRICT, WITHOUT ROWID;

CREATE TABLE camera_pose (  -- a row only where the pose changed
  episode INTEGER NOT NULL,
  camera INTEGER NOT NULL,
  frame INTEGER NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL, qx REAL NOT NULL, qy REAL NOT NULL, qz REAL NOT NULL, qw REAL NOT NULL,
  PRIMARY KEY (episode, camera, frame),
  FOREIGN KEY (episode, camera) REFERENCES camera (episode, ordinal)
) STRICT, WITHOUT ROWID;

CREATE TABLE action_channel (  -- the action spaces of an episode: names of their components, and units
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  space TEXT NOT NULL,
  component INTEGER NOT NULL,
  name TEXT NOT NULL,
  unit TEXT NOT NULL,
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;

CREATE TABLE action (  -- commanded over [frame, frame + 1); sixteen channels a row: 16 * part + i is in column i
  episode INTEGER NOT NULL REFERENCES episode (id),
  frame INTEGER NOT NULL,
  part INTEGER NOT NULL,
  value_0 REAL, value_1 REAL, value_2 REAL, value_3 REAL,
  value_4 REAL, value_5 REAL, value_6 REAL, value_7 REAL,
  value_8 REAL, value_9 REAL, value_10 REAL, value_11 REAL,
  value_12 REAL, value_13 REAL, value_14 REAL, value_15 REAL,
  PRIMARY KEY (episode, frame, part)
) STRICT, WITHOUT ROWID;

CREATE TABLE agent_action (  -- what an agent asked for: who drives the episode, or a policy that is a skill's body
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  frame INTEGER NOT NULL,  -- of the observation that it answers
  end_frame INTEGER NOT NULL,
  space TEXT NOT NULL,
  numbers TEXT NOT NULL,  -- JSON list
  gripper REAL,
  reference TEXT,  -- frame of a space of the tool
  controller TEXT,  -- where it names one
  most_frames INTEGER NOT NULL,  -- after which its step ended; 0: where it ends
  skill TEXT,
  arguments TEXT NOT NULL,  -- JSON list of names
  parameters TEXT NOT NULL,  -- JSON object of lists of numbers
  segment INTEGER,  -- of the skill whose policy asked; NULL: who drives the episode
  reward REAL,
  terminated INTEGER NOT NULL CHECK (terminated IN (0, 1)),
  truncated INTEGER NOT NULL CHECK (truncated IN (0, 1)),
  CHECK (frame <= end_frame),
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;

CREATE TABLE command (  -- every operation on the simulated world: what replay applies
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  step INTEGER NOT NULL,
  kind TEXT NOT NULL,
  payload BLOB NOT NULL,
  robot INTEGER NOT NULL DEFAULT 0,  -- which robot it is for, counted from 0
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;

CREATE TABLE channel (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  name TEXT NOT NULL,
  unit TEXT NOT NULL,
  rate_hz REAL NOT NULL,
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;

CREATE TABLE channel_component (
  episode INTEGER NOT NULL,
  channel INTEGER NOT NULL,
  ordinal INTEGER NOT NULL,
  name TEXT NOT NULL,
  PRIMARY KEY (episode, channel, ordinal),
  FOREIGN KEY (episode, channel) REFERENCES channel (episode, ordinal)
) STRICT, WITHOUT ROWID;

CREATE TABLE sample (  -- eight components a row: component 8 * part + i is in column i
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
