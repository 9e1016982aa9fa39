-- What was commanded over [frame, frame + 1) at every 20th frame: joints (rad), opening (m).
SELECT frame, action_j1, action_j2, action_j3, action_j4, action_j5, action_j6, action_j7, action_gripper
FROM steps WHERE episode = ?1 AND frame % 20 = 0 AND action_j1 IS NOT NULL ORDER BY frame;
