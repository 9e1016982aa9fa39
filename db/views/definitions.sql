CREATE VIEW definitions AS
SELECT e.id AS episode, e.task, d.kind, d.name, d.path, d.hash, d.source
FROM episode e
JOIN engine_run_definition r ON r.engine_run = e.engine_run
JOIN definition d ON d.kind = r.kind AND d.name = r.name AND d.hash = r.hash;
