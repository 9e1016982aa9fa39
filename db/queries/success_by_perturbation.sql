-- Success rate of each task along each perturbation of `stampede evaluate`, and how much it loses by it.
WITH trial AS (
  SELECT task, split, coalesce(options ->> 'policy', 'planner') AS policy,
         coalesce(options ->> 'perturb', 'none') AS perturbation, count(*) AS episodes,
         sum(outcome = 'success') AS successes
  FROM episodes
  GROUP BY 1, 2, 3, 4
)
SELECT t.task, t.split, t.policy, t.perturbation, t.episodes, t.successes,
       round(t.successes * 1.0 / t.episodes, 4) AS success_rate,
       round(u.successes * 1.0 / u.episodes - t.successes * 1.0 / t.episodes, 4) AS lost
FROM trial t
LEFT JOIN trial u ON u.task = t.task AND u.split = t.split AND u.policy = t.policy AND u.perturbation = 'none'
ORDER BY t.task, t.split, t.policy, t.perturbation <> 'none', t.perturbation;
