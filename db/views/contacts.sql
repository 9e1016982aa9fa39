CREATE VIEW contacts AS
SELECT c.episode, e.task, e.variation, e.seed, c.ordinal, c.object_a, c.part_a, c.object_b, c.part_b,
       c.first_frame * 1.0 / e.frame_hz AS start_s, c.end_frame * 1.0 / e.frame_hz AS end_s, c.first_frame, c.end_frame,
       c.peak_force
FROM contact c
JOIN episode e ON e.id = c.episode;
