-- Via-points passed at speed that no keyframe rule marks within one frame.
SELECT v.episode, v.skill, v.name, v.frame, round(v.speed, 3) AS speed, k.method
FROM vias v
JOIN (SELECT DISTINCT episode, method FROM keyframe) k ON k.episode = v.episode
WHERE v.speed > 0.1
  AND NOT EXISTS (SELECT 1 FROM keyframe f WHERE f.episode = v.episode AND f.method = k.method
                  AND f.frame BETWEEN v.frame - 1 AND v.frame + 1)
ORDER BY v.episode, v.ordinal, k.method;
