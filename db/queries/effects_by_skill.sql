-- How often the declared effects of each skill were tested and held, over segments that were kept.
SELECT skill, case_name, count(*) AS segments, count(effect_held) AS tested, sum(effect_held) AS held,
       round(avg(effect_held), 4) AS held_rate
FROM segments
WHERE kind = 'skill'
GROUP BY skill, case_name
ORDER BY held_rate, skill, case_name;
