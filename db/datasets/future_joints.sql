-- All joints at every 40th frame and 1, 5 and 20 frames after it (rad, m): kind (hinge, slider), whether the robot drives it, and which joint of its arm it is (1: next to the base).
SELECT frame, joint, kind, driven, arm_joint, position
FROM joints WHERE episode = ?1 AND frame % 40 IN (0, 1, 5, 20) ORDER BY frame, joint;
