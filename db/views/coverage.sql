CREATE VIEW coverage AS
SELECT task, variation, split, count(*) AS episodes, count(*) FILTER (WHERE outcome = 'success') AS successes,
       avg(CASE outcome WHEN 'success' THEN 1 ELSE 0 END) AS success_rate, min(seed) AS first_seed,
       max(seed) AS last_seed, avg(duration_s) AS mean_duration_s
FROM episode
GROUP BY task, variation, split;
