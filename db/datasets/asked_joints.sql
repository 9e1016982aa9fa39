-- The robot's joints, fingers included, frame by frame: position and velocity (rad, m), effort (N m, N); every 20th frame only.
SELECT frame, joint, position, velocity, effort FROM joints WHERE episode = ?1 AND driven AND frame % 20 = 0 ORDER BY frame, joint;
