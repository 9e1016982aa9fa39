-- Facts that changed during a skill though it neither declares nor forgets them, per skill.
SELECT s.skill, s.case_name, CASE WHEN u.negated THEN '(not ' || u.fact || ')' ELSE u.fact END AS literal,
       count(*) AS times, min(s.episode) AS first_episode
FROM undeclared_change u
CROSS JOIN segment s ON s.episode = u.episode AND s.undone = 0 AND s.ordinal = u.segment
GROUP BY s.skill, s.case_name, literal
ORDER BY times DESC, s.skill, s.case_name, literal;
