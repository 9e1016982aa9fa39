-- What was commanded over [frame, frame + 1): joints (rad), tip (m, world), opening (m); of the 20 frames from every 40th frame on.
SELECT frame, action_j1, action_j2, action_j3, action_j4, action_j5, action_j6, action_j7, action_x, action_y, action_z,
       action_qx, action_qy, action_qz, action_qw, action_gripper
FROM steps WHERE episode = ?1 AND frame % 40 < 20 ORDER BY frame;
