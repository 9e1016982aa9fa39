-- The facts that hold at every 40th frame, as spans of one frame.
SELECT f.predicate, f.arg1, f.arg2, f.arg3, f.arg4, f.fact, c.frame AS first_frame, c.frame + 1 AS end_frame,
       0 AS open_end, f.predicate_kind
FROM frames c JOIN facts f ON f.episode = c.episode AND f.first_frame <= c.frame AND f.end_frame > c.frame
WHERE c.episode = ?1 AND c.frame % 40 = 0 ORDER BY c.frame, f.fact;
