-- One row a skill for tasks/README.md: success at first try, and what the segments that were kept did beside it.
WITH first AS (
  SELECT skill, count(*) AS tries, sum(outcome = 'success') AS good FROM tries
  WHERE kind = 'skill' AND try_number = 1 GROUP BY skill
), kept AS (
  SELECT skill, count(*) AS segments, count(effect_held) AS tested, sum(effect_held) AS held FROM segments
  WHERE kind = 'skill' AND outcome = 'success' GROUP BY skill
), surprising AS (
  SELECT s.skill, count(*) AS segments
  FROM (SELECT DISTINCT episode, segment FROM undeclared_change) u
  CROSS JOIN segment s ON s.episode = u.episode AND s.undone = 0 AND s.ordinal = u.segment
  WHERE s.outcome = 'success' GROUP BY s.skill
)
SELECT skill, first.tries AS first_tries, round(100.0 * first.good / first.tries, 1) AS first_try_percent,
       kept.segments AS successful, kept.tested AS effects_tested, kept.held AS effects_held,
       coalesce(surprising.segments, 0) AS with_undeclared
FROM first LEFT JOIN kept USING (skill) LEFT JOIN surprising USING (skill)
ORDER BY skill;
