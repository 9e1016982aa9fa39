CREATE VIEW sensors AS
SELECT s.episode, c.name AS sensor, s.ordinal AS sample, s.step, s.step * 1.0 / e.physics_hz AS time_s,
       s.step * e.frame_hz / e.physics_hz AS frame, s.component, json_extract(c.components, '$[' || s.component || ']')
         AS name, c.unit, c.rate_hz, s.value
FROM sample s
JOIN episode e ON e.id = s.episode
JOIN channel c ON c.episode = s.episode AND c.ordinal = s.channel;
