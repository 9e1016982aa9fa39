CREATE VIEW transitions AS
WITH
-- Facts at both ends of a segment. One that is still true when the episode ends counts as true after its last segment.
state AS NOT MATERIALIZED (
  SELECT s.episode, s.ordinal AS segment, f.fact, f.predicate,
         max(f.start_step <= s.start_step AND (f.end_step > s.start_step OR f.open_end)) AS before,
         max(f.start_step <= s.end_step AND (f.end_step > s.end_step OR f.open_end)) AS after
  FROM segment s
  JOIN fact f ON f.episode = s.episode AND f.start_step <= s.end_step AND f.end_step >= s.start_step
  GROUP BY s.episode, s.ordinal, f.fact
),
change AS NOT MATERIALIZED (
  SELECT c.*, CASE WHEN c.after THEN c.fact ELSE '(not ' || c.fact || ')' END AS literal
  FROM state c
  WHERE c.before <> c.after
),
declaration AS NOT MATERIALIZED (
  SELECT d.episode, d.segment, d.ordinal, d.fact, d.negated,
         CASE WHEN d.negated THEN '(not ' || d.fact || ')' ELSE d.fact END AS literal,
         coalesce((SELECT c.after FROM state c
                   WHERE c.episode = d.episode AND c.segment = d.segment AND c.fact = d.fact), 0) AS after
  FROM segment_effect d
  WHERE NOT d.undone
)
SELECT s.episode, e.task, e.variation, e.seed, s.ordinal AS segment, s.kind, s.skill, s.case_name, s.arg1, s.arg2,
       s.arg3, s.arg4, s.label, s.outcome, s.reason,
       (SELECT json_group_array(fact) FROM
         (SELECT fact FROM state c WHERE c.episode = s.episode AND c.segment = s.ordinal AND c.before ORDER BY fact)) AS before,
       (SELECT json_group_array(fact) FROM
         (SELECT fact FROM state c WHERE c.episode = s.episode AND c.segment = s.ordinal AND c.after ORDER BY fact)) AS after,
       (SELECT json_group_array(fact) FROM
         (SELECT fact FROM change c WHERE c.episode = s.episode AND c.segment = s.ordinal AND c.after ORDER BY fact)) AS added,
       (SELECT json_group_array(fact) FROM
         (SELECT fact FROM change c
          WHERE c.episode = s.episode AND c.segment = s.ordinal AND NOT c.after ORDER BY fact)) AS removed,
       (SELECT json_group_array(literal) FROM
         (SELECT literal FROM declaration d
          WHERE d.episode = s.episode AND d.segment = s.ordinal ORDER BY d.ordinal)) AS declared,
       CASE WHEN s.kind = 'skill' THEN (SELECT json_group_array(literal) FROM
         (SELECT literal FROM declaration d
          WHERE d.episode = s.episode AND d.segment = s.ordinal AND d.after = d.negated ORDER BY d.ordinal)) END AS missing,
       CASE WHEN s.kind = 'skill' THEN (SELECT json_group_array(literal) FROM
         (SELECT literal FROM change c
          WHERE c.episode = s.episode AND c.segment = s.ordinal
            AND NOT EXISTS (SELECT 1 FROM segment_effect d
                            WHERE d.episode = c.episode AND NOT d.undone AND d.segment = c.segment AND d.fact = c.fact
                              AND d.negated <> c.after)
            AND NOT EXISTS (SELECT 1 FROM json_each(s.forgotten) g WHERE g.value = c.predicate)
            AND NOT EXISTS (SELECT 1 FROM predicate p
                            WHERE p.engine_run = e.engine_run AND p.name = c.predicate AND p.kind = 'derived')
          ORDER BY c.fact)) END AS undeclared
FROM segment s
JOIN episode e ON e.id = s.episode;
