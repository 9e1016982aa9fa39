-- Facts that changed during a skill though it neither declares nor forgets them, per skill.
SELECT t.skill, t.case_name, j.value AS literal, count(*) AS times, min(t.episode) AS first_episode
FROM transitions t, json_each(t.undeclared) j
WHERE t.kind = 'skill'
GROUP BY t.skill, t.case_name, j.value
ORDER BY times DESC, t.skill, t.case_name, literal;
