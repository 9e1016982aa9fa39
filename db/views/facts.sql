CREATE VIEW facts AS
SELECT f.episode, e.task, e.variation, e.seed, f.ordinal, f.predicate, f.arg1, f.arg2, f.arg3, f.arg4, f.fact,
       f.start_step * 1.0 / e.physics_hz AS start_s, f.end_step * 1.0 / e.physics_hz AS end_s,
       (f.end_step - f.start_step) * 1.0 / e.physics_hz AS duration_s, f.start_step, f.end_step, f.first_frame,
       f.end_frame, f.open_start, f.open_end, f.observed, f.margin, p.kind AS predicate_kind, f.labelled_by
FROM fact f
JOIN episode e ON e.id = f.episode
LEFT JOIN predicate p ON p.engine_run = e.engine_run AND p.name = f.predicate;
