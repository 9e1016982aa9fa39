CREATE VIEW joints AS
SELECT s.episode, s.frame, f.time_s, j.name AS joint, j.kind, j.unit, s.position, s.velocity, s.effort, j.lower,
       j.upper,
       j.driven
FROM joint_state s
JOIN joint j ON j.episode = s.episode AND j.ordinal = s.joint
JOIN frame f ON f.episode = s.episode AND f.frame = s.frame;
