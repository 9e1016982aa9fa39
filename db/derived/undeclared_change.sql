-- Rows of undeclared_change, from facts, segments and declared effects. What a segment adds begins inside it and what
-- it removes ends inside it: short ranges of fact_by_start and fact_by_end.
SELECT DISTINCT s.episode, s.ordinal AS segment, f.fact, 0 AS negated
FROM segment s
JOIN episode e ON e.id = s.episode
JOIN fact f ON f.episode = s.episode AND f.start_step > s.start_step AND f.start_step <= s.end_step
  AND (f.end_step > s.end_step OR f.open_end)
WHERE s.undone = 0 AND s.kind = 'skill'
  AND NOT EXISTS (SELECT 1 FROM fact o WHERE o.episode = s.episode AND o.fact = f.fact
                  AND o.start_step <= s.start_step AND (+o.end_step > s.start_step OR o.open_end))
  AND NOT EXISTS (SELECT 1 FROM segment_effect d
                  WHERE d.episode = s.episode AND d.undone = 0 AND d.segment = s.ordinal AND d.fact = f.fact
                    AND d.negated = 0)
  AND NOT EXISTS (SELECT 1 FROM json_each(s.forgotten) g WHERE g.value = f.predicate)
  AND NOT EXISTS (SELECT 1 FROM predicate p
                  WHERE p.engine_run = e.engine_run AND p.name = f.predicate AND p.kind = 'derived')
UNION ALL
SELECT DISTINCT s.episode, s.ordinal, f.fact, 1
FROM segment s
JOIN episode e ON e.id = s.episode
JOIN fact f ON f.episode = s.episode AND f.end_step > s.start_step AND f.end_step <= s.end_step AND NOT f.open_end
  AND +f.start_step <= s.start_step
WHERE s.undone = 0 AND s.kind = 'skill'
  AND NOT EXISTS (SELECT 1 FROM fact o WHERE o.episode = s.episode AND o.fact = f.fact
                  AND o.start_step <= s.end_step AND (+o.end_step > s.end_step OR o.open_end))
  AND NOT EXISTS (SELECT 1 FROM segment_effect d
                  WHERE d.episode = s.episode AND d.undone = 0 AND d.segment = s.ordinal AND d.fact = f.fact
                    AND d.negated = 1)
  AND NOT EXISTS (SELECT 1 FROM json_each(s.forgotten) g WHERE g.value = f.predicate)
  AND NOT EXISTS (SELECT 1 FROM predicate p
                  WHERE p.engine_run = e.engine_run AND p.name = f.predicate AND p.kind = 'derived')
