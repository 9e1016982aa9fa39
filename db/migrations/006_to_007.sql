-- changes joint
-- A joint may be a screw.
CREATE TEMP TABLE moved AS SELECT * FROM joint;
DROP TABLE joint;
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

INSERT INTO joint (episode, ordinal, name, body, part, kind, unit, lower, upper, driven)
SELECT episode, ordinal, name, body, part, kind, unit, lower, upper, driven FROM temp.moved;
DROP TABLE temp.moved;
