CREATE VIEW frames AS
SELECT f.episode, f.frame, f.step, f.time_s, f.reward, f.done, f.skill_segment, s.skill, s.label, f.motion_segment,
       m.skill AS motion
FROM frame f
LEFT JOIN segment s ON s.episode = f.episode AND s.undone = 0 AND s.ordinal = f.skill_segment
LEFT JOIN segment m ON m.episode = f.episode AND m.undone = 0 AND m.ordinal = f.motion_segment;
