CREATE VIEW poses AS  -- dense: the last stored pose is carried forward; CROSS keeps the order of loops
SELECT f.episode, (SELECT k.task FROM episode k WHERE k.id = f.episode) AS task,
       f.frame, f.time_s, p.name AS object, s.x, s.y, s.z, s.qx, s.qy, s.qz, s.qw,
       s.frame = f.frame AS changed
FROM frame f
CROSS JOIN posed p
CROSS JOIN object_state s
WHERE p.episode = f.episode AND s.episode = f.episode AND s.posed = p.ordinal
  AND s.frame = (SELECT max(o.frame) FROM object_state o
                 WHERE o.episode = f.episode AND o.posed = p.ordinal AND o.frame <= f.frame);
