CREATE VIEW failures AS  -- one row a failure: of a skill's call, of the verdict, or of an episode that got to neither
WITH failed AS (
  SELECT t.*
  FROM tries t
  LEFT JOIN segment p ON p.episode = t.episode AND p.undone = 0 AND p.ordinal = t.parent AND t.undone = 0
  WHERE t.outcome = 'failure' AND (t.kind = 'skill' OR (t.kind = 'motion' AND t.skill = 'hold'))
    AND NOT (coalesce(p.kind, '') = 'skill' AND coalesce(p.outcome, '') = 'failure')  -- told by the skill that called it
),
last AS (SELECT episode, max(segment) AS segment FROM failed WHERE undone = 0 GROUP BY episode),
ending AS (  -- what ended an episode
  SELECT f.episode, f.segment
  FROM failed f
  JOIN last l ON l.episode = f.episode AND l.segment = f.segment
  JOIN episode e ON e.id = f.episode
  WHERE f.undone = 0 AND e.outcome = 'failure' AND e.reason = f.reason
)
SELECT CASE WHEN f.undone = 0 AND d.segment IS NOT NULL THEN 'episode' ELSE 'try' END AS level,
       f.episode, f.task, f.variation, f.seed, f.undone, f.segment, f.kind, f.skill,
       f.case_name, f.arg1, f.arg2, f.arg3, f.arg4, f.start_s, f.end_s, f.reason, f.detail, f.missing_effects
FROM failed f
LEFT JOIN ending d ON d.episode = f.episode AND d.segment = f.segment
UNION ALL
SELECT 'episode', e.id, e.task, e.variation, e.seed, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, 0.0,
       e.duration_s, e.reason, e.detail, NULL
FROM episode e
WHERE e.outcome = 'failure' AND NOT EXISTS (SELECT 1 FROM ending d WHERE d.episode = e.id);
