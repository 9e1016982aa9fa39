-- One row an episode, and what is in its scene. Child rows are keyed (episode, ordinal).
CREATE TABLE reason (  -- why something failed: engine/base/reason.h, filled whenever a catalogue is opened to write
  name TEXT NOT NULL PRIMARY KEY
) STRICT, WITHOUT ROWID;

CREATE TABLE episode (
  id INTEGER PRIMARY KEY,
  key TEXT NOT NULL UNIQUE,  -- hash of definitions, task, variation, seed and every option that alters data
  task TEXT NOT NULL,
  world TEXT NOT NULL,
  variation TEXT,
  seed INTEGER,
  split TEXT NOT NULL CHECK (split IN ('train', 'test')),
  outcome TEXT NOT NULL CHECK (outcome IN ('success', 'failure')),
  reason TEXT NOT NULL REFERENCES reason (name),
  detail TEXT NOT NULL,
  beside_goal TEXT NOT NULL,  -- what success asks and the PDDL goal does not say
  frames INTEGER NOT NULL,
  steps INTEGER NOT NULL,      -- of physics; of a real episode: ticks, physics_hz a second
  duration_s REAL NOT NULL,
  physics_hz INTEGER NOT NULL,
  frame_hz INTEGER NOT NULL,
  draws REAL,                 -- NULL: a real episode, whose start nobody drew
  state_hash TEXT,
  source TEXT NOT NULL CHECK (source IN ('sim', 'real')),
  scene TEXT REFERENCES scene (hash),
  engine_run TEXT NOT NULL REFERENCES engine_run (hash),
  FOREIGN KEY (task, variation) REFERENCES variation (task, variation),
  CHECK ((source = 'real') = (variation IS NULL)),
  CHECK ((source = 'real') = (seed IS NULL)),
  CHECK ((source = 'real') = (state_hash IS NULL)),
  CHECK ((source = 'real') = (draws IS NULL)),
  CHECK (seed < 1000000 OR split = 'test'),
  CHECK ((outcome = 'success') = (reason = 'none'))
) STRICT;

CREATE TABLE timing (  -- of the host: the only table outside the content hash
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
  mask_id INTEGER NOT NULL,  -- of the mask of its name; 0: no mask has it
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

CREATE TABLE object_attribute (  -- authored texts and numbers
  episode INTEGER NOT NULL,
  object INTEGER NOT NULL,
  name TEXT NOT NULL,
  value ANY NOT NULL,
  PRIMARY KEY (episode, object, name, value),
  FOREIGN KEY (episode, object) REFERENCES object (episode, ordinal)
) STRICT, WITHOUT ROWID;

CREATE TABLE posed (  -- whose pose object_state holds
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  name TEXT NOT NULL,
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;

CREATE TABLE joint (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  name TEXT NOT NULL,
  body INTEGER NOT NULL,  -- index in the scene; -1: the robot
  part INTEGER NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('fixed', 'hinge', 'slider', 'screw')),
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
  focal_x REAL NOT NULL CHECK (focal_x > 0),  -- pixels
  focal_y REAL NOT NULL CHECK (focal_y > 0),
  centre_x REAL NOT NULL,    -- pixels from the upper left corner of the picture
  centre_y REAL NOT NULL,
  k1 REAL NOT NULL,          -- lens distortion, all 0: none
  k2 REAL NOT NULL,
  p1 REAL NOT NULL,
  p2 REAL NOT NULL,
  k3 REAL NOT NULL,
  near_m REAL NOT NULL,
  far_m REAL NOT NULL,
  mount_body TEXT NOT NULL,  -- empty: the world
  mount_part INTEGER NOT NULL,
  mount_link TEXT NOT NULL,  -- `panda.hand`; `world`
  vertical_fov_rad REAL NOT NULL,
  mount_matrix TEXT NOT NULL,  -- what the pose below is rounded from: 3 rows of 4, each number in full
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL, qx REAL NOT NULL, qy REAL NOT NULL, qz REAL NOT NULL, qw REAL NOT NULL,
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;
