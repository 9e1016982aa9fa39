-- One row a task for tasks/README.md: variations, skills, plan length, success, seconds an episode, demonstrations an hour.
WITH used AS MATERIALIZED (
  SELECT DISTINCT e.task, s.skill FROM segment s JOIN episode e ON e.id = s.episode
  WHERE s.undone = 0 AND s.kind = 'skill' AND s.outcome = 'success'
), lengths AS (  -- of plans: a skill that another one calls is no step
  SELECT s.episode, count(*) AS length FROM segment s
  LEFT JOIN segment p ON p.episode = s.episode AND p.undone = 0 AND p.ordinal = s.parent
  WHERE s.undone = 0 AND s.kind = 'skill' AND s.outcome = 'success' AND p.kind IS NOT 'skill'
  GROUP BY s.episode
)
SELECT e.task, count(DISTINCT e.variation) AS variations,
       (SELECT group_concat(skill, ' ') FROM (SELECT skill FROM used u WHERE u.task = e.task ORDER BY skill)) AS skills,
       round(avg(CASE WHEN e.outcome = 'success' THEN l.length END), 1) AS plan_length,
       count(*) AS episodes, sum(e.outcome = 'success') AS succeeded,
       round(avg(e.duration_s), 1) AS simulated_s, round(avg(t.wall_s), 2) AS wall_s,
       round(sum(e.duration_s) / sum(t.wall_s), 0) AS times_real_time,
       100 * round(36 * sum(e.outcome = 'success') / sum(t.wall_s)) AS successes_an_hour
FROM episode e LEFT JOIN timing t ON t.episode = e.id LEFT JOIN lengths l ON l.episode = e.id
GROUP BY e.task ORDER BY e.task;
