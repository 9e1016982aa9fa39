CREATE VIEW sensors AS  -- CROSS keeps the order of loops; a unit such as `N, N m` is of equal parts of the reading
SELECT s.episode, e.task, c.name AS sensor, s.ordinal AS sample, s.step, s.step * 1.0 / e.physics_hz AS time_s,
       (s.step * e.frame_hz - s.step * e.frame_hz % e.physics_hz) / e.physics_hz AS frame, n.ordinal AS component,
       n.name,
       CASE WHEN c.unit NOT LIKE '%, %' THEN c.unit
         ELSE (SELECT CASE WHEN total % json_array_length(list) THEN c.unit
                 ELSE json_extract(list, '$[' || (n.ordinal * json_array_length(list) / total) || ']') END
               FROM (SELECT '[' || replace(json_quote(c.unit), ', ', '", "') || ']' AS list,
                            (SELECT count(*) FROM channel_component o WHERE o.episode = e.id AND o.channel = c.ordinal)
                              AS total))
         END AS unit,
       c.rate_hz,
       CASE n.ordinal % 8 WHEN 0 THEN s.value_0 WHEN 1 THEN s.value_1 WHEN 2 THEN s.value_2 WHEN 3 THEN s.value_3
         WHEN 4 THEN s.value_4 WHEN 5 THEN s.value_5 WHEN 6 THEN s.value_6 WHEN 7 THEN s.value_7 END AS value
FROM episode e
CROSS JOIN channel c
CROSS JOIN sample s
CROSS JOIN channel_component n
WHERE c.episode = e.id AND s.episode = e.id AND s.channel = c.ordinal AND n.episode = e.id AND n.channel = c.ordinal
  AND n.ordinal BETWEEN 8 * s.part AND 8 * s.part + 7;
