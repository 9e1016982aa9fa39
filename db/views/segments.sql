CREATE VIEW segments AS
SELECT s.episode, e.task, e.variation, e.seed, s.ordinal AS segment, s.kind, s.parent, s.robot, s.skill, s.case_name,
       s.arg1, s.arg2, s.arg3,
       s.arg4, s.arguments, s.controller, s.start_step * 1.0 / e.physics_hz AS start_s,
       s.end_step * 1.0 / e.physics_hz AS end_s, (s.end_step - s.start_step) * 1.0 / e.physics_hz AS duration_s,
       s.start_step, s.end_step, s.first_frame, s.end_frame, s.outcome, s.reason, s.detail, s.precondition_held,
       s.effect_held, s.missing_effects, s.forgotten, s.searched_for, s.label,
       s.labelled_by
FROM segment s
JOIN episode e ON e.id = s.episode
WHERE s.undone = 0;
