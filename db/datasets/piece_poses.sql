-- Where each thing is before and after the skill (m, world; quaternion xyzw).
SELECT CASE p.frame WHEN s.first_frame THEN 'before' ELSE 'after' END AS moment, p.object, p.x, p.y, p.z, p.qx, p.qy, p.qz,
       p.qw
FROM segments s JOIN episodes e ON e.episode = s.episode
JOIN poses p ON p.episode = s.episode AND p.frame IN (s.first_frame, min(s.end_frame, e.frames - 1))
WHERE s.episode = ?1 AND s.segment = ?2 ORDER BY moment DESC, p.object;
