-- Declared effects that had not come true at the end of their segment, per skill and outcome.
SELECT s.skill, s.case_name, s.outcome, CASE WHEN d.negated THEN '(not ' || d.fact || ')' ELSE d.fact END AS literal,
       count(*) AS times, min(s.episode) AS first_episode
FROM segment_effect d
CROSS JOIN segment s ON s.episode = d.episode AND s.undone = 0 AND s.ordinal = d.segment
WHERE d.undone = 0 AND d.held = 0 AND s.kind = 'skill'
GROUP BY s.skill, s.case_name, s.outcome, literal
ORDER BY times DESC, s.skill, s.case_name, literal;
