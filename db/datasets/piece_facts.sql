-- The facts that hold before and after the skill.
SELECT 'before' AS moment, j.value AS fact FROM transitions t, json_each(t.before) j
WHERE t.episode = ?1 AND t.segment = ?2
UNION ALL
SELECT 'after', j.value FROM transitions t, json_each(t.after) j WHERE t.episode = ?1 AND t.segment = ?2
ORDER BY 1 DESC, 2;
