-- The rgb pictures nearest inside the start and the end of each skill segment, with its label.
WITH edges AS (
  SELECT s.episode, s.segment, s.skill, s.label, c.ordinal AS camera, m.column1 AS moment,
         s.first_frame, min(s.end_frame, e.frames - 1) AS last_frame
  FROM episode e
  CROSS JOIN segments s ON s.episode = e.id
  JOIN camera c ON c.episode = s.episode
  CROSS JOIN (VALUES ('start'), ('end')) m
  WHERE s.kind = 'skill' AND EXISTS (SELECT 1 FROM image i WHERE i.episode = e.id)),
shown AS (
  SELECT g.*, CASE moment
    WHEN 'start' THEN (SELECT i.frame FROM image i WHERE i.episode = g.episode AND i.camera = g.camera
                       AND i.kind = 'rgb' AND i.frame BETWEEN g.first_frame AND g.last_frame ORDER BY i.frame LIMIT 1)
    ELSE (SELECT i.frame FROM image i WHERE i.episode = g.episode AND i.camera = g.camera AND i.kind = 'rgb'
          AND i.frame BETWEEN g.first_frame AND g.last_frame ORDER BY i.frame DESC LIMIT 1) END AS frame
  FROM edges g)
SELECT i.episode, s.segment, s.skill, s.label, s.moment, i.frame, i.time_s, i.camera, i.width, i.height, i.bytes
FROM shown s
JOIN camera c ON c.episode = s.episode AND c.ordinal = s.camera
JOIN images i ON i.episode = s.episode AND i.frame = s.frame AND i.camera = c.name AND i.kind = 'rgb'
ORDER BY i.episode, s.segment, i.camera, i.frame, s.moment DESC;
