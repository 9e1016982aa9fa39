-- What was observed and commanded. Child rows of a frame carry (episode, frame, which).
CREATE TABLE frame (
  episode INTEGER NOT NULL REFERENCES episode (id),
  frame INTEGER NOT NULL,
  step INTEGER NOT NULL,
  time_s REAL NOT NULL,
  reward REAL NOT NULL,
  done INTEGER NOT NULL CHECK (done IN (0, 1)),
  skill_segment INTEGER,   -- innermost segments that run here
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

CREATE TABLE action (  -- commanded over [frame, frame + 1)
  episode INTEGER NOT NULL,
  frame INTEGER NOT NULL,
  channel INTEGER NOT NULL,
  value REAL NOT NULL,
  PRIMARY KEY (episode, frame, channel),
  FOREIGN KEY (episode, channel) REFERENCES action_channel (episode, ordinal)
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
  components TEXT NOT NULL,  -- JSON list of names
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
