CREATE VIEW transitions AS  -- a fact that is true when the episode ends counts as true after the last segment. What a
-- segment adds begins inside it and what it removes ends inside it: short ranges of fact_by_start and fact_by_end.
SELECT s.episode, e.task, e.variation, e.seed, s.ordinal AS segment, s.kind, s.skill, s.case_name, s.arg1, s.arg2,
       s.arg3, s.arg4, s.label, s.outcome, s.reason,
       (SELECT json_group_array(fact) FROM
         (SELECT DISTINCT f.fact FROM fact f
          WHERE f.episode = s.episode AND +f.start_step <= s.start_step AND (+f.end_step > s.start_step OR f.open_end)
          ORDER BY f.fact)) AS before,
       (SELECT json_group_array(fact) FROM
         (SELECT DISTINCT f.fact FROM fact f
          WHERE f.episode = s.episode AND +f.start_step <= s.end_step AND (+f.end_step > s.end_step OR f.open_end)
          ORDER BY f.fact)) AS after,
       (SELECT json_group_array(fact) FROM
         (SELECT DISTINCT f.fact FROM fact f
          WHERE f.episode = s.episode AND f.start_step > s.start_step AND f.start_step <= s.end_step
            AND (f.end_step > s.end_step OR f.open_end)
            AND NOT EXISTS (SELECT 1 FROM fact o WHERE o.episode = s.episode AND o.fact = f.fact
                            AND o.start_step <= s.start_step AND (+o.end_step > s.start_step OR o.open_end))
          ORDER BY f.fact)) AS added,
       (SELECT json_group_array(fact) FROM
         (SELECT DISTINCT f.fact FROM fact f
          WHERE f.episode = s.episode AND f.end_step > s.start_step AND f.end_step <= s.end_step AND NOT f.open_end
            AND +f.start_step <= s.start_step
            AND NOT EXISTS (SELECT 1 FROM fact o WHERE o.episode = s.episode AND o.fact = f.fact
                            AND o.start_step <= s.end_step AND (+o.end_step > s.end_step OR o.open_end))
          ORDER BY f.fact)) AS removed,
       (SELECT json_group_array(literal) FROM
         (SELECT CASE WHEN d.negated THEN '(not ' || d.fact || ')' ELSE d.fact END AS literal FROM segment_effect d
          WHERE d.episode = s.episode AND d.undone = 0 AND d.segment = s.ordinal
          ORDER BY d.ordinal)) AS declared,
       CASE WHEN s.kind = 'skill' THEN (SELECT json_group_array(literal) FROM
         (SELECT CASE WHEN d.negated THEN '(not ' || d.fact || ')' ELSE d.fact END AS literal FROM segment_effect d
          WHERE d.episode = s.episode AND d.undone = 0 AND d.segment = s.ordinal AND NOT d.held
          ORDER BY d.ordinal)) END AS missing,
       CASE WHEN s.kind = 'skill' THEN (SELECT json_group_array(literal) FROM
         (SELECT CASE WHEN u.negated THEN '(not ' || u.fact || ')' ELSE u.fact END AS literal FROM undeclared_change u
          WHERE u.episode = s.episode AND u.segment = s.ordinal
          ORDER BY u.fact)) END AS undeclared
FROM segment s
JOIN episode e ON e.id = s.episode
WHERE s.undone = 0;
