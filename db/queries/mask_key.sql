-- What the numbers in the masks of each episode stand for.
SELECT episode, instance, name, object, class, semantic, colour
FROM masks
ORDER BY episode, instance;
