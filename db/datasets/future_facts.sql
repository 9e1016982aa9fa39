-- The facts that hold at every 40th frame and 1, 5 and 20 frames after it; those that cannot change are left out.
SELECT c.frame, f.fact
FROM frames c JOIN facts f ON f.episode = c.episode AND f.first_frame <= c.frame AND f.end_frame > c.frame
WHERE c.episode = ?1 AND c.frame % 40 IN (0, 1, 5, 20) AND f.predicate_kind IN ('basic', 'derived')
ORDER BY c.frame, f.fact;
