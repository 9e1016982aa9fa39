-- How many pictures each episode has, and kB a picture, by camera and kind.
SELECT episode, task, camera, kind, count(*) AS pictures, min(width) || 'x' || min(height) AS size,
       round(sum(bytes) / 1000.0, 1) AS kb, round(avg(bytes) / 1000.0, 2) AS kb_a_frame
FROM images
GROUP BY episode, camera, kind
ORDER BY episode, camera, kind;
