-- Episodes, successes and success rate of each task and split.
SELECT task, split, sum(episodes) AS episodes, sum(successes) AS successes,
       round(sum(successes) * 1.0 / sum(episodes), 4) AS success_rate
FROM coverage
GROUP BY task, split
ORDER BY task, split;
