CREATE VIEW grasps AS
SELECT g.episode, e.task, e.variation, e.seed, g.ordinal, g.segment, s.skill, g.object, g.x, g.y, g.z, g.qx, g.qy, g.qz,
       g.qw, g.width, g.held
FROM grasp g
JOIN episode e ON e.id = g.episode
LEFT JOIN segment s ON s.episode = g.episode AND s.ordinal = g.segment;
