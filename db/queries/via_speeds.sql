-- How fast the arm passes its via-points: the least and the mean joint speed there, per skill and point.
SELECT skill, name, count(*) AS vias, round(min(speed), 4) AS slowest, round(avg(speed), 4) AS mean
FROM vias
GROUP BY skill, name
ORDER BY skill, name;
