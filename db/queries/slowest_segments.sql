-- The skill segments that took longest in simulated time.
SELECT skill, label, episode, segment, start_s, round(duration_s, 3) AS duration_s, controller
FROM segments
WHERE kind = 'skill'
ORDER BY segments.duration_s DESC, episode, segment
LIMIT 50;
