-- Joints of things, such as doors and drawers (rad, m); every 40th frame and the one before it.
SELECT frame, joint, position, velocity FROM joints WHERE episode = ?1 AND NOT driven AND frame % 40 IN (39, 0) ORDER BY frame, joint;
