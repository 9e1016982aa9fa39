CREATE VIEW hands AS
SELECT s.episode, (SELECT k.task FROM episode k WHERE k.id = s.episode) AS task,
       s.frame, f.time_s, h.name AS hand, s.x, s.y, s.z, s.qx, s.qy, s.qz, s.qw, s.linear_x, s.linear_y,
       s.linear_z, s.angular_x, s.angular_y, s.angular_z, s.opening, s.touch_1, s.touch_2
FROM hand_state s
JOIN hand h ON h.episode = s.episode AND h.ordinal = s.hand
JOIN frame f ON f.episode = s.episode AND f.frame = s.frame;
