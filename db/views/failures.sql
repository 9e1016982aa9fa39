CREATE VIEW failures AS  -- one row a failure: of a skill's call, of the verdict, or of an episode that got to neither
WITH failed AS NOT MATERIALIZED (
  SELECT t.*
  FROM tries t
  LEFT JOIN segment p ON p.episode = t.episode AND p.undone = 0 AND p.ordinal = t.parent AND t.undone = 0
  WHERE t.outcome = 'failure' AND (t.kind = 'skill' OR (t.kind = 'motion' AND t.skill = 'hold'))
    AND NOT (coalesce(p.kind, '') = 'skill' AND coalesce(p.outcome, '') = 'failure')  -- told by the skill that called it
),
ending AS NOT MATERIALIZED (  -- what ended an episode: the last of its failures, if that has its reason
  SELECT e.id AS episode,
         (SELECT f.segment FROM failed f
          WHERE f.episode = e.id AND f.undone = 0 AND f.reason = e.reason
            AND f.segment = (SELECT max(l.segment) FROM failed l WHERE l.episode = e.id AND l.undone = 0)) AS segment
  FROM episode e
  WHERE e.outcome = 'failure'
)
SELECT CASE WHEN f.undone = 0 AND d.segment = f.segment THEN 'episode' ELSE 'try' END AS level,
       f.episode, f.task, f.variation, f.seed, f.undone, f.segment, f.kind, f.skill,
       f.case_name, f.arg1, f.arg2, f.arg3, f.arg4, f.start_s, f.end_s, f.reason, f.detail, f.missing_effects
FROM failed f
LEFT JOIN ending d ON d.episode = f.episode
UNION ALL
SELECT 'episode', e.id, e.task, e.variation, e.seed, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, 0.0,
       e.duration_s, e.reason, e.detail, NULL
FROM ending d
JOIN episode e ON e.id = d.episode
WHERE d.segment IS NULL;
