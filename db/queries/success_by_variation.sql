-- Success rate of each variation, worst first.
SELECT task, variation, split, episodes, successes, round(success_rate, 4) AS success_rate
FROM coverage
ORDER BY success_rate, task, variation, split;
