-- All joints, the robot's and those of things, before and after the skill (rad, m), and which joint of the arm it is (1: next to the base).
SELECT CASE j.frame WHEN s.first_frame THEN 'before' ELSE 'after' END AS moment, j.joint, j.arm_joint, j.position
FROM segments s JOIN episodes e ON e.episode = s.episode
JOIN joints j ON j.episode = s.episode AND j.frame IN (s.first_frame, min(s.end_frame, e.frames - 1))
WHERE s.episode = ?1 AND s.segment = ?2 ORDER BY moment DESC, j.joint;
