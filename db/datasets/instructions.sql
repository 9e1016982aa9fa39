-- What was asked for, in words.
SELECT text FROM instructions WHERE episode = ?1 AND level = 'task' ORDER BY ordinal;
