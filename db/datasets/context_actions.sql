-- What was commanded over [frame, frame + 1): joints (rad, from the base on; NULL beyond those that an arm has), tip (m, world), opening (m); of the 20 frames from every 40th frame on.
SELECT frame, action_j*, action_x, action_y, action_z, action_qx, action_qy, action_qz, action_qw, action_gripper
FROM steps WHERE episode = ?1 AND frame % 40 < 20 ORDER BY frame;
