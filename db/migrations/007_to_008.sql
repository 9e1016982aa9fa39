-- changes language fact
-- Sentences of all kinds of segments, by people and models too, facts that people or models labelled, and what real
-- recordings need: streams with their clocks, when pictures were taken, and NULL where they have no value.
CREATE TEMP TABLE moved AS SELECT * FROM language;
DROP TABLE language;
CREATE TABLE language (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  level TEXT NOT NULL CHECK (level IN ('task', 'world', 'subgoal', 'skill', 'motion')),
  segment INTEGER,
  text TEXT NOT NULL,
  source TEXT NOT NULL CHECK (source IN ('template', 'model', 'person')),
  grain TEXT CHECK (grain IN ('goal', 'steps', 'motions')),
  model TEXT,
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;

INSERT INTO language (episode, ordinal, level, segment, text, source)
SELECT episode, ordinal, level, segment, text, source FROM temp.moved;
DROP TABLE temp.moved;

ALTER TABLE fact ADD COLUMN labelled_by TEXT NOT NULL DEFAULT 'simulator' CHECK (labelled_by IN ('simulator', 'person', 'model'));
CREATE INDEX IF NOT EXISTS fact_by_predicate ON fact (predicate, arg1, arg2);
CREATE INDEX IF NOT EXISTS fact_by_text ON fact (episode, fact, start_step, end_step, open_end);
CREATE INDEX IF NOT EXISTS fact_by_start ON fact (episode, start_step);
CREATE INDEX IF NOT EXISTS fact_by_end ON fact (episode, end_step);
CREATE INDEX IF NOT EXISTS fact_hidden ON fact (episode, predicate, observed) WHERE observed = 0;

CREATE TABLE stream (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  kind TEXT NOT NULL,
  name TEXT NOT NULL,
  file TEXT NOT NULL,
  clock TEXT NOT NULL,
  offset_s REAL NOT NULL,
  drift_ppm REAL NOT NULL,
  reference_s REAL NOT NULL,
  origin_s REAL NOT NULL,
  rate_hz REAL NOT NULL,
  readings INTEGER NOT NULL,
  longest_gap_s REAL NOT NULL,
  missing INTEGER NOT NULL,
  rule TEXT NOT NULL,
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;

CREATE TABLE image_time (
  episode INTEGER NOT NULL,
  frame INTEGER NOT NULL,
  camera INTEGER NOT NULL,
  kind TEXT NOT NULL,
  time_s REAL NOT NULL,
  PRIMARY KEY (episode, frame, camera, kind),
  FOREIGN KEY (episode, frame) REFERENCES frame (episode, frame),
  FOREIGN KEY (episode, camera) REFERENCES camera (episode, ordinal)
) STRICT, WITHOUT ROWID;

-- to write: the same columns, which may be empty
CREATE TABLE main.made (
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
  draws REAL,
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

INSERT INTO main.made SELECT * FROM main.episode;
DROP TABLE main.episode;
ALTER TABLE main.made RENAME TO episode;

CREATE TABLE main.made (
  episode INTEGER NOT NULL REFERENCES episode (id),
  frame INTEGER NOT NULL,
  step INTEGER NOT NULL,
  time_s REAL NOT NULL,
  reward REAL,
  done INTEGER NOT NULL CHECK (done IN (0, 1)),
  skill_segment INTEGER,
  motion_segment INTEGER,
  subgoal_segment INTEGER,
  motion TEXT,
  subgoal TEXT,
  PRIMARY KEY (episode, frame)
) STRICT, WITHOUT ROWID;

INSERT INTO main.made SELECT * FROM main.frame;
DROP TABLE main.frame;
ALTER TABLE main.made RENAME TO frame;

CREATE TABLE main.made (
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

INSERT INTO main.made SELECT * FROM main.hand_state;
DROP TABLE main.hand_state;
ALTER TABLE main.made RENAME TO hand_state;
