-- Pictures, where the catalogue holds some: PNG files, depth in 0.1 mm.
SELECT frame, camera, kind, width, height, focal_x, focal_y, centre_x, centre_y, data
FROM images WHERE episode = ?1 AND kind IN ('rgb', 'depth') ORDER BY frame, camera, kind;
