CREATE VIEW visible AS  -- a row for each instance mask and each thing that has a number, seen or not
SELECT i.episode, (SELECT k.task FROM episode k WHERE k.id = i.episode) AS task,
       i.frame, f.time_s, c.name AS camera, m.instance, m.name, m.object, m.class,
       coalesce(p.pixels, 0) AS pixels, coalesce(p.pixels, 0) * 1.0 / (i.width * i.height) AS part
FROM image i
JOIN frame f ON f.episode = i.episode AND f.frame = i.frame
JOIN camera c ON c.episode = i.episode AND c.ordinal = i.camera
JOIN mask m ON m.episode = i.episode
LEFT JOIN mask_pixels p ON p.episode = i.episode AND p.frame = i.frame AND p.camera = i.camera
  AND p.instance = m.instance
WHERE i.kind = 'instance';
