-- Where each thing is, frame by frame (m, world; quaternion xyzw); every 20th frame only.
SELECT frame, object, x, y, z, qx, qy, qz, qw FROM poses WHERE episode = ?1 AND frame % 20 = 0 ORDER BY frame, object;
