-- Joints of things, such as doors and drawers, frame by frame (rad, m); every 20th frame only.
SELECT frame, joint, position, velocity FROM joints WHERE episode = ?1 AND NOT driven AND frame % 20 = 0 ORDER BY frame, joint;
