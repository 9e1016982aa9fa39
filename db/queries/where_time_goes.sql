-- Host time per simulated second of each task, and the part of it that is physics steps.
SELECT task, count(*) AS episodes, round(sum(wall_s) / sum(duration_s), 4) AS wall_per_simulated_s,
       round(sum(physics_wall_s) / sum(wall_s), 4) AS physics_part
FROM episodes
GROUP BY task
ORDER BY task;
