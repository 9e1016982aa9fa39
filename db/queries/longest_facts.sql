-- The facts that held longest without a break, and for how many seconds.
SELECT fact, episode, task, start_s, end_s, round(duration_s, 3) AS duration_s, open_end
FROM facts
WHERE coalesce(predicate_kind, 'basic') = 'basic'
ORDER BY facts.duration_s DESC, episode, ordinal
LIMIT 50;
