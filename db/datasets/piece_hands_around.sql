-- The tip of the hand before and after the skill (m, world; quaternion xyzw), its opening (m) and the force at its pads (N).
SELECT CASE h.frame WHEN s.first_frame THEN 'before' ELSE 'after' END AS moment, h.hand, h.x, h.y, h.z, h.qx, h.qy, h.qz,
       h.qw, h.opening, h.touch_1, h.touch_2
FROM segments s JOIN episodes e ON e.episode = s.episode
JOIN hands h ON h.episode = s.episode AND h.frame IN (s.first_frame, min(s.end_frame, e.frames - 1))
WHERE s.episode = ?1 AND s.segment = ?2 ORDER BY moment DESC, h.hand;
