-- One row a task for tasks/README.md: variations, skills, plan length, success, seconds an episode, demonstrations an hour.
WITH used AS (
  SELECT DISTINCT e.task, s.skill FROM segment s JOIN episode e ON e.id = s.episode
  WHERE s.undone = 0 AND s.kind = 'skill' AND s.outcome = 'success'
), steps AS (
  SELECT e.id, count(*) AS length FROM episode e JOIN segment s ON s.episode = e.id
  WHERE e.outcome = 'success' AND s.undone = 0 AND s.kind = 'skill' AND s.outcome = 'success'
    AND NOT EXISTS (SELECT 1 FROM segment p WHERE p.episode = s.episode AND p.undone = 0 AND p.ordinal = s.parent AND p.kind = 'skill')
  GROUP BY e.id
)
SELECT e.task, count(DISTINCT e.variation) AS variations,
       (SELECT group_concat(skill, ' ') FROM (SELECT skill FROM used u WHERE u.task = e.task ORDER BY skill)) AS skills,
       (SELECT round(avg(length), 1) FROM steps JOIN episode o ON o.id = steps.id WHERE o.task = e.task) AS plan_length,
       count(*) AS episodes, sum(e.outcome = 'success') AS succeeded,
       round(avg(e.duration_s), 1) AS simulated_s, round(avg(t.wall_s), 2) AS wall_s,
       round(sum(e.duration_s) / sum(t.wall_s), 0) AS times_real_time,
       100 * round(36 * sum(e.outcome = 'success') / sum(t.wall_s)) AS successes_an_hour
FROM episode e LEFT JOIN timing t ON t.episode = e.id
GROUP BY e.task ORDER BY e.task;
