CREATE VIEW failures AS  -- every try that failed, and every episode that failed as a whole
SELECT 'try' AS level, t.episode, t.task, t.variation, t.seed, t.undone, t.segment, t.kind, t.skill, t.case_name,
       t.arg1, t.arg2, t.arg3, t.arg4, t.start_s, t.end_s, t.reason, t.detail, t.missing_effects
FROM tries t
WHERE t.outcome = 'failure'
UNION ALL
SELECT 'episode', e.id, e.task, e.variation, e.seed, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, 0.0,
       e.duration_s,
       e.reason, e.detail, NULL
FROM episode e
WHERE e.outcome = 'failure';
