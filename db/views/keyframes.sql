CREATE VIEW keyframes AS
SELECT k.episode, e.task, e.variation, e.seed, k.method, k.frame, f.time_s, f.skill_segment, s.skill, s.label
FROM keyframe k
JOIN episode e ON e.id = k.episode
LEFT JOIN frame f ON f.episode = k.episode AND f.frame = k.frame
LEFT JOIN segment s ON s.episode = k.episode AND s.undone = 0 AND s.ordinal = f.skill_segment;
