-- Of successes that went as planned, how far the plan has come at each frame, 0 to 1: skills done, and the share of time of
-- the one that runs.
SELECT f.frame,
       ((SELECT count(*) FROM segments s WHERE s.episode = ?1 AND s.kind = 'skill' AND s.end_frame <= f.frame)
        + coalesce((SELECT max((f.frame - s.first_frame) * 1.0 / (s.end_frame - s.first_frame)) FROM segments s
                    WHERE s.episode = ?1 AND s.kind = 'skill' AND s.first_frame <= f.frame AND s.end_frame > f.frame), 0))
       * 1.0 / p.steps AS progress
FROM frames f JOIN (SELECT steps FROM plans WHERE episode = ?1 AND steps > 0) p
WHERE f.episode = ?1 AND (SELECT outcome FROM episodes WHERE episode = ?1) = 'success'
  AND p.steps = (SELECT count(*) FROM segments WHERE episode = ?1 AND kind = 'skill')
  AND NOT EXISTS (SELECT 1 FROM segments WHERE episode = ?1 AND kind = 'skill' AND outcome = 'failure')
ORDER BY f.frame;
