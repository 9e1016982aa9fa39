-- What happened, in words: segments with undone tries, facts, contacts, language, documents.
CREATE TABLE segment (
  episode INTEGER NOT NULL REFERENCES episode (id),
  undone INTEGER NOT NULL CHECK (undone IN (0, 1)),  -- 1: a try that was undone; its steps and frames count on a time
                                                     -- line that no longer exists
  ordinal INTEGER NOT NULL,     -- in the episode; of what was undone: among what was undone
  was_ordinal INTEGER,          -- of an undone one: of the segment that it was, while it was
  before_segment INTEGER,       -- of an undone one: the segment that took its place, or the number of segments
  try_number INTEGER NOT NULL,  -- at its place, from 1
  kind TEXT NOT NULL CHECK (kind IN ('subgoal', 'skill', 'motion', 'control')),
  parent INTEGER,
  robot TEXT NOT NULL,
  skill TEXT NOT NULL,
  case_name TEXT NOT NULL,
  arg1 TEXT,
  arg2 TEXT,
  arg3 TEXT,
  arg4 TEXT,
  arguments TEXT NOT NULL,  -- JSON list of names
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
  missing_effects TEXT NOT NULL,  -- JSON list of literals
  forgotten TEXT NOT NULL,        -- JSON list of predicates
  searched_for TEXT NOT NULL,     -- JSON list of hidden facts that the plan assumed and this showed, true or not
  label TEXT NOT NULL,
  labelled_by TEXT NOT NULL CHECK (labelled_by IN ('simulator', 'person', 'model')),
  CHECK (start_step <= end_step AND first_frame <= end_frame),
  CHECK ((was_ordinal IS NOT NULL) = undone AND (before_segment IS NOT NULL) = undone),
  PRIMARY KEY (episode, undone, ordinal)
) STRICT, WITHOUT ROWID;

CREATE TABLE segment_parameter (
  episode INTEGER NOT NULL REFERENCES episode (id),
  undone INTEGER NOT NULL CHECK (undone IN (0, 1)),  -- with segment: whose it is
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

CREATE TABLE segment_precondition (  -- ground, with what was found when a call began
  episode INTEGER NOT NULL REFERENCES episode (id),
  undone INTEGER NOT NULL CHECK (undone IN (0, 1)),
  segment INTEGER NOT NULL,
  ordinal INTEGER NOT NULL,
  choice INTEGER,  -- which `or` or `exists` it is a way to meet; NULL: it must hold
  negated INTEGER NOT NULL CHECK (negated IN (0, 1)),
  predicate TEXT NOT NULL,
  arg1 TEXT,
  arg2 TEXT,
  arg3 TEXT,
  arg4 TEXT,
  fact TEXT NOT NULL,  -- (on block1 table)
  held INTEGER NOT NULL CHECK (held IN (0, 1)),
  PRIMARY KEY (episode, undone, segment, ordinal)
) STRICT, WITHOUT ROWID;

CREATE TABLE segment_effect (  -- declared effects, ground
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
  fact TEXT NOT NULL,  -- (on block1 table)
  held INTEGER CHECK (held IN (0, 1)),  -- at the segment's end, by the facts; NULL: the try was undone
  PRIMARY KEY (episode, undone, segment, ordinal)
) STRICT, WITHOUT ROWID;

CREATE TABLE undeclared_change (  -- of basic facts, neither declared nor forgotten by the skill. Follows from fact
  episode INTEGER NOT NULL REFERENCES episode (id),
  segment INTEGER NOT NULL,
  fact TEXT NOT NULL,
  negated INTEGER NOT NULL CHECK (negated IN (0, 1)),
  PRIMARY KEY (episode, segment, fact)
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
  fact TEXT NOT NULL,  -- (on block1 table)
  start_step INTEGER NOT NULL,
  end_step INTEGER NOT NULL,
  first_frame INTEGER NOT NULL,
  end_frame INTEGER NOT NULL,
  open_start INTEGER NOT NULL CHECK (open_start IN (0, 1)),
  open_end INTEGER NOT NULL CHECK (open_end IN (0, 1)),
  observed INTEGER NOT NULL CHECK (observed IN (0, 1)),  -- known all the time
  margin REAL,
  labelled_by TEXT NOT NULL DEFAULT 'simulator' CHECK (labelled_by IN ('simulator', 'person', 'model')),
  PRIMARY KEY (episode, ordinal),
  CHECK (start_step <= end_step AND first_frame <= end_frame)
) STRICT, WITHOUT ROWID;

CREATE TABLE observed_fact (  -- of predicates that can hide: when they were known to hold
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
  level TEXT NOT NULL CHECK (level IN ('task', 'world', 'subgoal', 'skill', 'motion')),
  segment INTEGER,
  text TEXT NOT NULL,
  source TEXT NOT NULL CHECK (source IN ('template', 'model', 'person')),
  grain TEXT CHECK (grain IN ('goal', 'steps', 'motions')),  -- how much of the way it says
  model TEXT,  -- which model said it
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

CREATE TABLE verdict (  -- on the end of an episode by the rule of the dialect that its goal was written in
  episode INTEGER NOT NULL REFERENCES episode (id),
  dialect TEXT NOT NULL CHECK (dialect IN ('libero', 'behavior')),
  theirs INTEGER NOT NULL CHECK (theirs IN (0, 1)),
  ours INTEGER NOT NULL CHECK (ours IN (0, 1)),
  disagreements TEXT NOT NULL,  -- JSON list of texts
  PRIMARY KEY (episode, dialect)
) STRICT, WITHOUT ROWID;

CREATE TABLE keyframe (
  episode INTEGER NOT NULL REFERENCES episode (id),
  method TEXT NOT NULL,
  frame INTEGER NOT NULL,
  PRIMARY KEY (episode, method, frame)
) STRICT, WITHOUT ROWID;
