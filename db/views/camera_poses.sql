CREATE VIEW camera_poses AS  -- dense: the last stored pose is carried forward; CROSS keeps the order of loops
SELECT f.episode, (SELECT k.task FROM episode k WHERE k.id = f.episode) AS task,
       f.frame, f.time_s, c.name AS camera, s.x, s.y, s.z, s.qx, s.qy, s.qz, s.qw, c.width, c.height,
       c.focal_x, c.focal_y, c.centre_x, c.centre_y, c.near_m, c.far_m
FROM frame f
CROSS JOIN camera c
CROSS JOIN camera_pose s
WHERE c.episode = f.episode AND s.episode = f.episode AND s.camera = c.ordinal
  AND s.frame = (SELECT max(o.frame) FROM camera_pose o
                 WHERE o.episode = f.episode AND o.camera = c.ordinal AND o.frame <= f.frame);
