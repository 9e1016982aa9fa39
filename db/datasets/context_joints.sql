-- The robot's joints, fingers included, frame by frame: position and velocity (rad, m), effort (N m, N); every 40th frame and the one before it.
SELECT frame, joint, position, velocity, effort FROM joints WHERE episode = ?1 AND driven AND frame % 40 IN (39, 0) ORDER BY frame, joint;
