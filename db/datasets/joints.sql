-- The robot's joints, fingers included, frame by frame: which joint of the arm it is (1: next to the base; NULL: a finger), position and velocity (rad, m), effort (N m, N).
SELECT frame, joint, arm_joint, position, velocity, effort
FROM joints WHERE episode = ?1 AND driven ORDER BY frame, arm_joint NULLS LAST, joint;
