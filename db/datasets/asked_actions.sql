-- What was commanded over [frame, frame + 1) at every 20th frame: joints (rad, from the base on; NULL beyond those that an arm has), opening (m).
SELECT frame, action_j*, action_gripper
FROM steps WHERE episode = ?1 AND frame % 20 = 0 AND action_j1 IS NOT NULL ORDER BY frame;
