CREATE VIEW frames AS
SELECT f.episode, (SELECT k.task FROM episode k WHERE k.id = f.episode) AS task,
       f.frame, f.step, f.time_s, f.reward, f.done, f.skill_segment, s.skill, s.label, f.motion_segment,
       f.motion
FROM frame f
LEFT JOIN segment s ON s.episode = f.episode AND s.undone = 0 AND s.ordinal = f.skill_segment;
