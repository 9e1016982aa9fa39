CREATE VIEW images AS  -- a picture may have another size than its camera: the vertical field of view is the camera's
SELECT i.episode, e.task, e.variation, e.seed, i.frame, f.time_s, c.name AS camera, i.kind, i.width, i.height,
       c.focal_x * i.height / c.height AS focal_x, c.focal_y * i.height / c.height AS focal_y,
       i.width / 2.0 + (c.centre_x - c.width / 2.0) * i.height / c.height AS centre_x,
       c.centre_y * i.height / c.height AS centre_y, length(i.data) AS bytes, i.data
FROM image i
JOIN episode e ON e.id = i.episode
JOIN frame f ON f.episode = i.episode AND f.frame = i.frame
JOIN camera c ON c.episode = i.episode AND c.ordinal = i.camera;
