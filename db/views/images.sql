CREATE VIEW images AS  -- a picture may have another size than its camera: the vertical field of view is the camera's
SELECT i.episode, e.task, e.variation, e.seed, i.frame, f.time_s, c.name AS camera, i.kind, i.width, i.height,
       c.focal_x * i.height / c.height AS focal_x, c.focal_y * i.height / c.height AS focal_y,
       i.width / 2.0 + (c.centre_x - c.width / 2.0) * i.height / c.height AS centre_x,
       c.centre_y * i.height / c.height AS centre_y, length(i.data) AS bytes, i.data,
       CASE WHEN i.kind = 'points' THEN 'ply' WHEN substr(i.data, 1, 2) = x'ffd8' THEN 'jpeg' ELSE 'png' END AS encoding,
       t.time_s AS taken_s
FROM image i
JOIN episode e ON e.id = i.episode
JOIN frame f ON f.episode = i.episode AND f.frame = i.frame
JOIN camera c ON c.episode = i.episode AND c.ordinal = i.camera
LEFT JOIN image_time t ON t.episode = i.episode AND t.frame = i.frame AND t.camera = i.camera AND t.kind = i.kind;
