-- The facts that hold before and after the skill; those that cannot change are left out.
SELECT m.moment, m.fact
FROM (SELECT 'before' AS moment, t.episode, j.value AS fact FROM transitions t, json_each(t.before) j
      WHERE t.episode = ?1 AND t.segment = ?2
      UNION ALL
      SELECT 'after', t.episode, j.value FROM transitions t, json_each(t.after) j
      WHERE t.episode = ?1 AND t.segment = ?2) m
WHERE m.fact IN (SELECT f.fact FROM facts f WHERE f.episode = ?1 AND f.predicate_kind IN ('basic', 'derived'))
ORDER BY m.moment DESC, m.fact;
