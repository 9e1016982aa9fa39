CREATE VIEW grasps AS  -- a grasp belongs to the motion that closed the hand, and that to a skill
SELECT g.episode, e.task, e.variation, e.seed, g.ordinal, s.ordinal AS segment, g.segment AS motion, s.skill, g.object,
       g.x, g.y, g.z, g.qx, g.qy, g.qz, g.qw, 2 * (g.qx * g.qz + g.qw * g.qy) AS approach_x,
       2 * (g.qy * g.qz - g.qw * g.qx) AS approach_y, 1 - 2 * (g.qx * g.qx + g.qy * g.qy) AS approach_z,
       2 * (h.qx * h.qz + h.qw * h.qy) AS world_approach_x, 2 * (h.qy * h.qz - h.qw * h.qx) AS world_approach_y,
       1 - 2 * (h.qx * h.qx + h.qy * h.qy) AS world_approach_z, g.width, g.held
FROM grasp g
JOIN episode e ON e.id = g.episode
LEFT JOIN segment m ON m.episode = g.episode AND m.undone = 0 AND m.ordinal = g.segment
LEFT JOIN segment s ON s.episode = g.episode AND s.undone = 0
  AND s.ordinal = CASE m.kind WHEN 'motion' THEN m.parent ELSE m.ordinal END
LEFT JOIN hand_state h ON h.episode = g.episode AND h.frame = m.first_frame AND h.hand = 0;
