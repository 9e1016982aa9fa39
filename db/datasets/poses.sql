-- Where each thing is, frame by frame (m, world; quaternion xyzw).
SELECT frame, object, x, y, z, qx, qy, qz, qw FROM poses WHERE episode = ?1 ORDER BY frame, object;
