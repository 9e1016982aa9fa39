-- The tip of the hand while the skill runs, frames counted from its first (m, world; quaternion xyzw), opening (m).
SELECT h.frame - s.first_frame AS frame, h.hand, h.x, h.y, h.z, h.qx, h.qy, h.qz, h.qw, h.linear_x, h.linear_y,
       h.linear_z, h.angular_x, h.angular_y, h.angular_z, h.opening, h.touch_1, h.touch_2
FROM segments s JOIN hands h ON h.episode = s.episode AND h.frame >= s.first_frame AND h.frame < s.end_frame
WHERE s.episode = ?1 AND s.segment = ?2 ORDER BY h.frame, h.hand;
