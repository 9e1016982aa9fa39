-- Where each thing is, frame by frame (m, world; quaternion xyzw); every 40th frame and the one before it.
SELECT frame, object, x, y, z, qx, qy, qz, qw FROM poses WHERE episode = ?1 AND frame % 40 IN (39, 0) ORDER BY frame, object;
