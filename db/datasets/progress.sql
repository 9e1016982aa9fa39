-- How far the plan has come at each frame, 0 to 1: skills that succeeded, and of the one that runs the share of its time.
SELECT f.frame,
       (coalesce((SELECT count(*) FROM segments s WHERE s.episode = ?1 AND s.kind = 'skill' AND s.parent IS NULL
                  AND s.outcome = 'success' AND s.end_frame <= f.frame), 0)
        + coalesce((SELECT max((f.frame - s.first_frame) * 1.0 / (s.end_frame - s.first_frame)) FROM segments s
                    WHERE s.episode = ?1 AND s.kind = 'skill' AND s.parent IS NULL AND s.outcome = 'success'
                    AND s.first_frame <= f.frame AND s.end_frame > f.frame), 0))
       * 1.0 / max(p.steps, 1) AS progress
FROM frames f JOIN (SELECT steps FROM plans WHERE episode = ?1) p
WHERE f.episode = ?1 ORDER BY f.frame;
