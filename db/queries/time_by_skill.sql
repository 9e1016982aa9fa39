-- Simulated time that each skill takes when it succeeds.
SELECT skill, case_name, count(*) AS segments, round(min(duration_s), 3) AS shortest_s,
       round(avg(duration_s), 3) AS mean_s, round(max(duration_s), 3) AS longest_s
FROM segments
WHERE kind = 'skill' AND outcome = 'success'
GROUP BY skill, case_name
ORDER BY mean_s DESC, skill, case_name;
