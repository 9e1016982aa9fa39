-- What was commanded over [frame, frame + 1): joints (rad, from the base on; NULL beyond those that an arm has), tip (m, world), opening (m).
SELECT frame, action_j*, action_x, action_y, action_z, action_qx, action_qy, action_qz, action_qw, action_gripper
FROM steps WHERE episode = ?1 ORDER BY frame;
