-- Joints of things, such as doors and drawers, frame by frame (rad, m).
SELECT frame, joint, position, velocity FROM joints WHERE episode = ?1 AND NOT driven ORDER BY frame, joint;
