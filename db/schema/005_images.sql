-- What cameras saw, and what the numbers in instance and semantic masks stand for.
CREATE TABLE mask (
  episode INTEGER NOT NULL REFERENCES episode (id),
  instance INTEGER NOT NULL CHECK (instance > 0),  -- 0 is the background
  name TEXT NOT NULL,
  object TEXT NOT NULL,
  class TEXT NOT NULL,
  semantic INTEGER NOT NULL CHECK (semantic > 0),
  colour TEXT,  -- of the object
  PRIMARY KEY (episode, instance)
) STRICT, WITHOUT ROWID;

CREATE TABLE image (  -- with rowids: rows are too long for a key's tree
  episode INTEGER NOT NULL REFERENCES episode (id),
  frame INTEGER NOT NULL,
  camera INTEGER NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('rgb', 'depth', 'instance', 'semantic', 'points')),
  width INTEGER NOT NULL CHECK (width > 0),
  height INTEGER NOT NULL CHECK (height > 0),
  data BLOB NOT NULL,  -- PNG; points: binary PLY
  PRIMARY KEY (episode, frame, camera, kind),
  FOREIGN KEY (episode, frame) REFERENCES frame (episode, frame),
  FOREIGN KEY (episode, camera) REFERENCES camera (episode, ordinal)
) STRICT;

CREATE TABLE mask_pixels (  -- pixels in instance masks: a row for each thing that a mask shows. Follows from image
  episode INTEGER NOT NULL,
  frame INTEGER NOT NULL,
  camera INTEGER NOT NULL,
  instance INTEGER NOT NULL,
  pixels INTEGER NOT NULL CHECK (pixels > 0),
  PRIMARY KEY (episode, frame, camera, instance),
  FOREIGN KEY (episode, instance) REFERENCES mask (episode, instance)
) STRICT, WITHOUT ROWID;
