-- Declared effects that had not come true at the end of their segment, per skill and outcome.
SELECT t.skill, t.case_name, t.outcome, j.value AS literal, count(*) AS times, min(t.episode) AS first_episode
FROM transitions t, json_each(t.missing) j
WHERE t.kind = 'skill'
GROUP BY t.skill, t.case_name, t.outcome, j.value
ORDER BY times DESC, t.skill, t.case_name, literal;
