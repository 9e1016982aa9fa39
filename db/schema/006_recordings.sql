-- Where the frames of a real episode come from: what was recorded, on which clock, and when each picture was taken.
CREATE TABLE stream (
  episode INTEGER NOT NULL REFERENCES episode (id),
  ordinal INTEGER NOT NULL,
  kind TEXT NOT NULL,          -- joints gripper command wrench channel rgb depth
  name TEXT NOT NULL,          -- of the camera or channel; of the others their kind
  file TEXT NOT NULL,          -- in the recording folder
  clock TEXT NOT NULL,         -- empty: the recording's own
  offset_s REAL NOT NULL,      -- time = stamp + offset_s + drift_ppm / 1e6 * (stamp - reference_s)
  drift_ppm REAL NOT NULL,
  reference_s REAL NOT NULL,
  origin_s REAL NOT NULL,      -- that time at frame 0
  rate_hz REAL NOT NULL,       -- readings a second, by the median way between two
  readings INTEGER NOT NULL,   -- within the episode
  longest_gap_s REAL NOT NULL,
  missing INTEGER NOT NULL,    -- frames that have no value of it
  rule TEXT NOT NULL,          -- how it became frames: linear nearest hold kept
  PRIMARY KEY (episode, ordinal)
) STRICT, WITHOUT ROWID;

CREATE TABLE image_time (  -- when the picture of a frame was taken: up to half a frame before or after it
  episode INTEGER NOT NULL,
  frame INTEGER NOT NULL,
  camera INTEGER NOT NULL,
  kind TEXT NOT NULL,
  time_s REAL NOT NULL,
  PRIMARY KEY (episode, frame, camera, kind),
  FOREIGN KEY (episode, frame) REFERENCES frame (episode, frame),
  FOREIGN KEY (episode, camera) REFERENCES camera (episode, ordinal)
) STRICT, WITHOUT ROWID;
