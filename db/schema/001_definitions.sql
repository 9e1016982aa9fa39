-- What took part, each kept once: scripts, vocabulary, scenes, long texts, engine runs.
CREATE TABLE definition (  -- a script as it was
  kind TEXT NOT NULL CHECK (kind IN ('task', 'skill', 'predicate', 'object', 'world', 'robot', 'types', 'colours',
                                     'module')),
  name TEXT NOT NULL,
  hash TEXT NOT NULL,
  path TEXT NOT NULL,
  source TEXT NOT NULL,
  PRIMARY KEY (kind, name, hash)
) STRICT, WITHOUT ROWID;

CREATE TABLE engine_run (  -- all that episodes of one run share and that can alter data
  hash TEXT NOT NULL PRIMARY KEY,  -- of everything below and of the two tables that follow
  engine_version TEXT NOT NULL,
  numerics TEXT NOT NULL,          -- hash of a fixed probe: same build, same class of processor
  options TEXT NOT NULL            -- JSON object without seed and split, which are columns of episode
) STRICT, WITHOUT ROWID;

CREATE TABLE engine_run_definition (
  engine_run TEXT NOT NULL REFERENCES engine_run (hash),
  kind TEXT NOT NULL,
  name TEXT NOT NULL,
  hash TEXT NOT NULL,
  PRIMARY KEY (engine_run, kind, name, hash),
  FOREIGN KEY (kind, name, hash) REFERENCES definition (kind, name, hash)
) STRICT, WITHOUT ROWID;

CREATE TABLE predicate (
  engine_run TEXT NOT NULL REFERENCES engine_run (hash),
  name TEXT NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('basic', 'derived', 'fixed')),
  PRIMARY KEY (engine_run, name)
) STRICT, WITHOUT ROWID;

CREATE TABLE variation (
  task TEXT NOT NULL,
  variation TEXT NOT NULL,  -- canonical text, such as colour=red,height=3
  PRIMARY KEY (task, variation)
) STRICT, WITHOUT ROWID;

CREATE TABLE variation_axis (
  task TEXT NOT NULL,
  variation TEXT NOT NULL,
  axis TEXT NOT NULL,
  value TEXT NOT NULL,
  PRIMARY KEY (task, variation, axis),
  FOREIGN KEY (task, variation) REFERENCES variation (task, variation)
) STRICT, WITHOUT ROWID;

CREATE TABLE split (  -- NULL: any task, any variation, no bound
  name TEXT NOT NULL CHECK (name IN ('train', 'test')),
  task TEXT,
  variation TEXT,
  first_seed INTEGER,
  end_seed INTEGER
) STRICT;
INSERT INTO split VALUES ('train', NULL, NULL, NULL, 1000000), ('test', NULL, NULL, 1000000, NULL);

CREATE TABLE scene (
  hash TEXT NOT NULL PRIMARY KEY,  -- of the whole document
  document TEXT NOT NULL           -- JSON; {"$asset": hash} stands for a text of table asset
) STRICT, WITHOUT ROWID;

CREATE TABLE asset (  -- parts of documents that many scenes share: shapes and their points
  hash TEXT NOT NULL PRIMARY KEY,
  body TEXT NOT NULL
) STRICT, WITHOUT ROWID;

CREATE TABLE text_store (  -- long texts that many episodes share
  hash TEXT NOT NULL PRIMARY KEY,
  body TEXT NOT NULL
) STRICT, WITHOUT ROWID;
