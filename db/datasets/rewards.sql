-- The reward after each frame's action: 1 where the task is done.
SELECT frame, reward, done FROM frames WHERE episode = ?1 ORDER BY frame;
