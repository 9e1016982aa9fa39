-- Pictures, where the catalogue holds some: PNG (of real robots also JPEG) files, depth in 0.1 mm; lens (pixel) and pose of the camera (m, world; quaternion xyzw; x right, y down, z forward).
SELECT i.frame, i.camera, i.kind, i.width, i.height, i.focal_x, i.focal_y, i.centre_x, i.centre_y, p.x, p.y, p.z, p.qx,
       p.qy, p.qz, p.qw, i.data
FROM images i LEFT JOIN camera_poses p ON p.episode = i.episode AND p.frame = i.frame AND p.camera = i.camera
WHERE i.episode = ?1 AND i.kind IN ('rgb', 'depth')
  -- Where only some frames have pictures, those of skills' beginnings would tell where skills begin.
  AND (i.frame = 0 OR i.frame IN (SELECT frame FROM keyframes WHERE episode = ?1 AND method = 'stopped')
       OR (SELECT source = 'real' FROM episodes WHERE episode = ?1)
       OR (SELECT count(DISTINCT frame) FROM images WHERE episode = ?1) = (SELECT frames FROM episodes WHERE episode = ?1))
ORDER BY i.frame, i.camera, i.kind;
