-- The robot's joints, fingers included, frame by frame: position and velocity (rad, m), effort (N m, N).
SELECT frame, joint, position, velocity, effort FROM joints WHERE episode = ?1 AND driven ORDER BY frame, joint;
