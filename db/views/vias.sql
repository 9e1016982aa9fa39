CREATE VIEW vias AS
SELECT v.episode, e.task, v.ordinal, v.segment, s.parent AS skill_segment, k.skill, v.name, v.x, v.y, v.z, v.qx, v.qy, v.qz,
       v.qw,
       v.passed_x, v.passed_y, v.passed_z, v.passed_qx, v.passed_qy, v.passed_qz, v.passed_qw, v.step,
       v.step * 1.0 / e.physics_hz AS time_s,
       (v.step * e.frame_hz - v.step * e.frame_hz % e.physics_hz) / e.physics_hz AS frame, v.speed, v.tool_speed
FROM via v
JOIN episode e ON e.id = v.episode
LEFT JOIN segment s ON s.episode = v.episode AND s.undone = 0 AND s.ordinal = v.segment
LEFT JOIN segment k ON k.episode = v.episode AND k.undone = 0 AND k.ordinal = s.parent;
