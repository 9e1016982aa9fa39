CREATE VIEW actions AS
SELECT episode, (SELECT k.task FROM episode k WHERE k.id = episode) AS task, frame, time_s, space, component, name, unit, value
FROM (SELECT s.episode, s.frame, f.time_s, c.space, c.component, c.name, c.unit,
             CASE c.ordinal % 16 WHEN 0 THEN s.value_0 WHEN 1 THEN s.value_1 WHEN 2 THEN s.value_2
               WHEN 3 THEN s.value_3 WHEN 4 THEN s.value_4 WHEN 5 THEN s.value_5 WHEN 6 THEN s.value_6
               WHEN 7 THEN s.value_7 WHEN 8 THEN s.value_8 WHEN 9 THEN s.value_9 WHEN 10 THEN s.value_10
               WHEN 11 THEN s.value_11 WHEN 12 THEN s.value_12 WHEN 13 THEN s.value_13 WHEN 14 THEN s.value_14
               WHEN 15 THEN s.value_15 END AS value
      FROM action s
      JOIN action_channel c ON c.episode = s.episode AND c.ordinal BETWEEN 16 * s.part AND 16 * s.part + 15
      JOIN frame f ON f.episode = s.episode AND f.frame = s.frame)
WHERE value IS NOT NULL;
